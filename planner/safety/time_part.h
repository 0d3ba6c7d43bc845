// A part of an interval in time.
#pragma once

#include <cstddef>

namespace tern {

/// The index-th of 1, 2 or 4 equal parts of an interval.
struct TimePart {
  static constexpr int kMaxParts = 4;       ///< the largest number of parts of an interval
  static constexpr int kSlots = 1 + 2 + 4;  ///< number of different parts, of all lengths

  int interval = 0;
  int index = 0;  ///< 0 … of − 1
  int of = 1;

  [[nodiscard]] double u0() const { return static_cast<double>(index) / of; }      ///< start of the part, u ∈ [0, 1]
  [[nodiscard]] double u1() const { return static_cast<double>(index + 1) / of; }  ///< end of the part
  [[nodiscard]] bool is_last() const { return index + 1 == of; }
  [[nodiscard]] bool has_halves() const { return of < kMaxParts; }
  [[nodiscard]] TimePart half(int k) const { return {interval, 2 * index + k, 2 * of}; }
  /// Returns a number 0 … kSlots − 1 that is unique among the parts of an interval.
  [[nodiscard]] std::size_t slot() const {
    const int place = of - 1 + index;
    return static_cast<std::size_t>(place);
  }
};

}  // namespace tern
