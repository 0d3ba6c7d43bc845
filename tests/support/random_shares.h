// Random shares of α at lower levels of confidence.
#pragma once

#include <algorithm>
#include <functional>

#include "core/base/random.h"
#include "core/world/track.h"

namespace tern::support {

/// Returns sorted shares, uniform in [0.001, 1].
inline AlphaShares random_shares(Rng& rng) {
  AlphaShares shares{};
  for (float& share : shares) share = static_cast<float>(rng.uniform(1e-3, 1.0));
  std::sort(shares.begin(), shares.end(), std::greater<>());
  return shares;
}

}  // namespace tern::support
