// What is left of α at lower levels of confidence, drawn from a seed.
#pragma once

#include <algorithm>
#include <functional>

#include "core/base/random.h"
#include "core/world/track.h"

namespace tern::support {

/// Uniform in [0.001, 1], sorted.
inline AlphaShares random_shares(Rng& rng) {
  AlphaShares shares{};
  for (float& share : shares) share = static_cast<float>(rng.uniform(1e-3, 1.0));
  std::sort(shares.begin(), shares.end(), std::greater<>());
  return shares;
}

}  // namespace tern::support
