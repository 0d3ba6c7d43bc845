// Percentiles of measured numbers by the nearest-rank method. All of Tern uses this definition.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

namespace tern {

/// Returns the index, from 0, of a percentile among n sorted numbers: ⌈n · percent / 100⌉ − 1. At least `percent` % of
/// the numbers are at most as large as the one at this index. A percentile is therefore always one of the numbers.
/// @pre n > 0, percent in 1 … 100
constexpr std::size_t nearest_rank(std::size_t n, std::size_t percent) { return (n * percent + 99) / 100 - 1; }

/// Returns a percentile of numbers in ascending order. @pre `sorted` is not empty, percent in 1 … 100
inline double percentile_of_sorted(const std::vector<double>& sorted, std::size_t percent) {
  return sorted[nearest_rank(sorted.size(), percent)];
}

/// Four percentiles of one set of numbers. All are NaN if the set is empty.
struct Percentiles {
  double p50 = std::numeric_limits<double>::quiet_NaN();
  double p95 = std::numeric_limits<double>::quiet_NaN();
  double p99 = std::numeric_limits<double>::quiet_NaN();
  double max = std::numeric_limits<double>::quiet_NaN();
};

/// Returns the percentiles of `samples`, in any order. O(n). @pre no sample is NaN
Percentiles percentiles(std::vector<double> samples);

}  // namespace tern
