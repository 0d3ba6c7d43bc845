// The share of a track's error bound α that a test applies: all of it, or less.
#pragma once

#include <cstddef>
#include <limits>

#include "core/world/track.h"

namespace tern {

/// The part of α that applies: α at one level of confidence, times a scale. From a chosen piece on it may stay
/// constant.
struct AlphaShare {
  int level = 0;       ///< index into kConfidenceLevels
  double scale = 1.0;  ///< [0, 1], multiplies α at that level
  /// On later pieces α is at most its value on this piece.
  std::size_t grows_to = std::numeric_limits<std::size_t>::max();

  /// Returns the applied α of a piece, m.
  [[nodiscard]] Vec3 of(const Track& track, std::size_t piece) const {
    const auto at = [&](std::size_t k) -> Vec3 { return scale * track.alpha_at(k, level); };
    return piece <= grows_to ? at(piece) : Vec3(at(piece).cwiseMin(at(grows_to)));
  }
};

/// Returns Track::bounds() with a share of α instead of all of it.
/// @param first  where to begin: all pieces before this one end before t0
Box bounds_at(const Track& track, UTime t0, UTime t1, const AlphaShare& share, PiecewiseCubic::Located first);

}  // namespace tern
