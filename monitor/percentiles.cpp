#include "monitor/percentiles.h"

#include <algorithm>
#include <cstddef>

namespace tern {

Percentiles percentiles(std::vector<double> samples) {
  if (samples.empty()) return {};
  const auto rank = [&samples](std::size_t percent) {
    const std::size_t k = (samples.size() * percent + 99) / 100 - 1;
    const auto at = samples.begin() + static_cast<std::ptrdiff_t>(k);
    std::nth_element(samples.begin(), at, samples.end());
    return *at;
  };
  return {rank(50), rank(95), rank(99), rank(100)};
}

}  // namespace tern
