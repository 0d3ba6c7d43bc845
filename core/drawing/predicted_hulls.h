// Hulls of the places that predicted obstacles may occupy while a plan is flown, interval by interval.
#pragma once

#include <cstdint>
#include <vector>

#include "core/world/track.h"
#include "core/world/vehicle.h"

namespace tern {

/// The hull of one track over one interval.
struct PredictedHull {
  std::int64_t track = 0;
  int interval = 0;
  Points points;  ///< 3×m: extreme points, W, m
};

/// The hulls of a plan.
struct PredictedHulls {
  std::vector<PredictedHull> hulls;  ///< of the tracks nearest to the plan first
  int left_out = 0;                  ///< number of hulls beyond `most`
};

/// Makes a hull for each interval of the plan that begins before `ahead`, and each moving track within `reach` of it.
/// The hull is conv of the track's box grown by α and swept along the prediction (core/world/track_sweep.h): the
/// paper's C_ij without the vehicle's body.
/// @param ahead  > 0, from the plan's start
/// @param reach  m, ≥ 0: greatest distance between the track's box in an interval and the plan's curve
/// @param most   greatest number of hulls; each costs about 40 µs
PredictedHulls predicted_hulls(const TrackSet& tracks, const TimedSpline& plan, Duration ahead, double reach, int most);

}  // namespace tern
