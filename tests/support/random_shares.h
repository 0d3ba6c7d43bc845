// Random shares of α at lower levels of confidence.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>

#include "core/base/random.h"
#include "core/world/track.h"

namespace tern::support {

/// Returns shares that are uniform in [0.001, 1], and sorted on each axis.
inline AlphaShares random_shares(Rng& rng) {
  AlphaShares shares{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::array<float, shares.size()> of_axis{};
    for (float& share : of_axis) share = static_cast<float>(rng.uniform(1e-3, 1.0));
    std::ranges::sort(of_axis, std::greater<>());
    for (std::size_t k = 0; k < shares.size(); ++k) shares[k][axis] = of_axis[k];
  }
  return shares;
}

}  // namespace tern::support
