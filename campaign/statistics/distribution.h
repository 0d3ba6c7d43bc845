// A set of numbers in six.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

namespace tern {

/// NaN each when there were no numbers.
struct Distribution {
  std::int64_t count = 0;
  double mean = std::numeric_limits<double>::quiet_NaN();
  double p50 = std::numeric_limits<double>::quiet_NaN();
  double p95 = std::numeric_limits<double>::quiet_NaN();
  double p99 = std::numeric_limits<double>::quiet_NaN();
  double min = std::numeric_limits<double>::quiet_NaN();
  double max = std::numeric_limits<double>::quiet_NaN();
};

/// Percentiles by nearest rank (core/base/percentiles.h). Numbers that are NaN (a measure that a flight does not have)
/// are left out. O(n log n).
Distribution describe(std::vector<double> numbers);

}  // namespace tern
