// Percentiles of measured times.
#pragma once

#include <limits>
#include <vector>

namespace tern {

/// NaN each when there was nothing to rank.
struct Percentiles {
  double p50 = std::numeric_limits<double>::quiet_NaN();
  double p95 = std::numeric_limits<double>::quiet_NaN();
  double p99 = std::numeric_limits<double>::quiet_NaN();
  double max = std::numeric_limits<double>::quiet_NaN();
};

/// By nearest rank: the q-th percentile is the least sample that at least q % of all samples do not exceed; so each is
/// a sample.
/// @pre no sample is NaN. O(n).
Percentiles percentiles(std::vector<double> samples);

}  // namespace tern
