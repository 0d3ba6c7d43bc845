// How much of a prediction's α counts: all of it, at the promised level, or less.
#pragma once

#include <cstddef>
#include <limits>

#include "core/world/track.h"

namespace tern {

/// Of a track's α: its share at a level, scaled.
struct AlphaShare {
  int level = 0;       ///< of kConfidenceLevels
  double scale = 1.0;  ///< [0, 1], on top of it
  /// The piece from which on α counts as there at most: it grows no more.
  std::size_t grows_to = std::numeric_limits<std::size_t>::max();

  [[nodiscard]] Vec3 of(const Track& track, std::size_t piece) const {
    const auto at = [&](std::size_t k) -> Vec3 { return (scale * track.share_at(k, level)) * track.alpha[k]; };
    return piece <= grows_to ? at(piece) : Vec3(at(piece).cwiseMin(at(grows_to)));
  }
};

/// Track::bounds(), as far as what counts of α makes it sure.
/// @param first  pieces before this one end before t0 and need not be looked at
Box bounds_at(const Track& track, UTime t0, UTime t1, const AlphaShare& count, PiecewiseCubic::Located first);

}  // namespace tern
