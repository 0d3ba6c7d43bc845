// Mean, percentiles and range of a set of numbers.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

namespace tern {

/// All NaN for an empty set.
struct Distribution {
  std::int64_t count = 0;
  double mean = std::numeric_limits<double>::quiet_NaN();
  double p50 = std::numeric_limits<double>::quiet_NaN();
  double p95 = std::numeric_limits<double>::quiet_NaN();
  double p99 = std::numeric_limits<double>::quiet_NaN();
  double min = std::numeric_limits<double>::quiet_NaN();
  double max = std::numeric_limits<double>::quiet_NaN();
};

/// Describes the numbers that are not NaN; a flight without the measure has NaN. Percentiles are by nearest rank
/// (core/base/percentiles.h). O(n log n).
Distribution describe(std::vector<double> numbers);

}  // namespace tern
