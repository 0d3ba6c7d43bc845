// Counts what this executable allocates: its operator new is replaced (Eigen's matrices use malloc and are not seen).
#pragma once

#include <cstddef>

namespace tern {

/// From construction on. One at a time; one thread.
class AllocationMeter {
 public:
  AllocationMeter();
  [[nodiscard]] std::size_t largest() const;  ///< the largest single allocation, bytes
  [[nodiscard]] std::size_t peak() const;     ///< the most held at once beyond what was held at the start, bytes
};

}  // namespace tern
