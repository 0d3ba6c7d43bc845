#include "core/base/percentiles.h"

#include <algorithm>

namespace tern {

Percentiles percentiles(std::vector<double> samples) {
  if (samples.empty()) return {};
  const auto rank = [&samples](std::size_t percent) {
    const auto at = samples.begin() + static_cast<std::ptrdiff_t>(nearest_rank(samples.size(), percent));
    std::nth_element(samples.begin(), at, samples.end());
    return *at;
  };
  return {rank(50), rank(95), rank(99), rank(100)};
}

}  // namespace tern
