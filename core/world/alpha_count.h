// How much of a prediction's α counts: all of it, at the promised level, or less.
#pragma once

#include "core/world/track.h"

namespace tern {

/// Of a track's α: its share at a level, scaled.
struct AlphaCount {
  int level = 0;       ///< of kConfidenceLevels
  double scale = 1.0;  ///< [0, 1], on top of it

  [[nodiscard]] Vec3 of(const Track& track, std::size_t piece) const {
    return (scale * track.share_at(piece, level)) * track.alpha[piece];
  }
};

/// Track::bounds(), as far as what counts of α makes it sure.
Box counted_bounds(const Track& track, UTime t0, UTime t1, const AlphaCount& count);

}  // namespace tern
