// Where obstacles may be while a plan is flown: their predicted hulls, interval by interval.
#pragma once

#include <cstdint>
#include <vector>

#include "core/world/track.h"
#include "core/world/vehicle.h"

namespace tern {

struct PredictedHull {
  std::int64_t track = 0;
  int interval = 0;
  Points points;  ///< 3×m: the extreme points, W, m
};

struct PredictedHulls {
  std::vector<PredictedHull> hulls;  ///< the tracks nearest to the plan first
  int left_out = 0;                  ///< hulls that were not made because there were `most` already
};

/// A hull for each interval of the plan and each moving track that may come within `reach` of it. It is conv of the
/// track's box grown by its α, swept along the prediction (core/world/track_sweep.h): the paper's C_ij without the
/// vehicle's body.
/// @param reach  m, ≥ 0: a hull is made where the track's box in that interval is no farther from the plan's curve
/// @param most   hulls made at most; each costs about 40 µs
PredictedHulls predicted_hulls(const TrackSet& tracks, const TimedSpline& plan, double reach, int most);

}  // namespace tern
