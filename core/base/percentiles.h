// Percentiles of measured numbers, by nearest rank: the one definition that all of Tern uses.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

namespace tern {

/// The place, from 0, of the percent-th percentile among n sorted numbers: the least number that at least `percent` %
/// of all do not exceed. So a percentile is always one of the numbers.
/// @pre n > 0, percent in 1 … 100
constexpr std::size_t nearest_rank(std::size_t n, std::size_t percent) { return (n * percent + 99) / 100 - 1; }

/// The percentile of numbers in ascending order. @pre not empty, percent in 1 … 100
inline double percentile_of_sorted(const std::vector<double>& sorted, std::size_t percent) {
  return sorted[nearest_rank(sorted.size(), percent)];
}

/// NaN each when there was nothing to rank.
struct Percentiles {
  double p50 = std::numeric_limits<double>::quiet_NaN();
  double p95 = std::numeric_limits<double>::quiet_NaN();
  double p99 = std::numeric_limits<double>::quiet_NaN();
  double max = std::numeric_limits<double>::quiet_NaN();
};

/// @pre no sample is NaN. O(n).
Percentiles percentiles(std::vector<double> samples);

}  // namespace tern
