#include "campaign/statistics/distribution.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tern {

Distribution describe(std::vector<double> numbers) {
  std::erase_if(numbers, [](double x) { return std::isnan(x); });
  if (numbers.empty()) return {};
  std::sort(numbers.begin(), numbers.end());
  const std::size_t n = numbers.size();
  const auto rank = [&](std::size_t percent) { return numbers[(n * percent + 99) / 100 - 1]; };
  Distribution d;
  d.count = static_cast<std::int64_t>(n);
  d.mean = std::accumulate(numbers.begin(), numbers.end(), 0.0) / static_cast<double>(n);
  d.p50 = rank(50), d.p95 = rank(95), d.p99 = rank(99);
  d.min = numbers.front(), d.max = numbers.back();
  return d;
}

}  // namespace tern
