#include "campaign/statistics/distribution.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/percentiles.h"

namespace tern {

Distribution describe(std::vector<double> numbers) {
  std::erase_if(numbers, [](double x) { return std::isnan(x); });
  if (numbers.empty()) return {};
  std::sort(numbers.begin(), numbers.end());
  const std::size_t n = numbers.size();
  Distribution d;
  d.count = static_cast<std::int64_t>(n);
  d.mean = std::accumulate(numbers.begin(), numbers.end(), 0.0) / static_cast<double>(n);
  d.p50 = percentile_of_sorted(numbers, 50);
  d.p95 = percentile_of_sorted(numbers, 95);
  d.p99 = percentile_of_sorted(numbers, 99);
  d.min = numbers.front(), d.max = numbers.back();
  return d;
}

}  // namespace tern
