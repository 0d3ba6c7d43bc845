// Measures the allocations of this executable by replacing operator new. (Eigen's matrices use malloc and are not
// included.)
#pragma once

#include <cstddef>

namespace tern {

/// Measures from its construction on. One instance at a time, one thread.
class AllocationMeter {
 public:
  AllocationMeter();
  [[nodiscard]] std::size_t largest() const;  ///< the largest single allocation, bytes
  [[nodiscard]] std::size_t peak() const;     ///< the largest total held at once, beyond that at the start, bytes
};

}  // namespace tern
