// How far an obstacle can reach where its end is hidden: no farther than where a sensor saw empty space.
#pragma once

#include "core/base/types.h"
#include "core/world/sighting.h"

namespace tern {

/// Hidden ends are followed outwards in steps of this, m, and this far.
inline constexpr double kEndStep = 0.2, kFarthestEnd = 8.0;
/// A section wider than this, m, is looked for at its corners as well.
inline constexpr double kWideSection = 0.5;

/// Returns how far beyond the face of a box the obstacle can reach, at most `farthest`, m. It ends where a part of the
/// box's section was seen to be empty, at two places in turn.
///
/// If a box reached farther, all of its section would be filled there, and the sensor would not have seen through it.
/// Nor would the sensor be inside it. An obstacle may pass close beside the sensor, so no room about it counts as
/// empty. That an obstacle fills its box is an assumption: the rest of a wall that is turned in W may be cut off.
/// @param box  the part that was seen, W
/// @param side  −1: the lower face of the axis, 1: the upper one
/// @param error  of the box's place, m: its section is taken to be narrower by this, and empty space to begin farther
double seen_empty_beyond(const SensorView& view, const Box& box, int axis, int side, double farthest, double error);

}  // namespace tern
