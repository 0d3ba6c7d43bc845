// Whether a sensor looked where a track should be, and saw through it.
#pragma once

#include "core/base/types.h"
#include "core/world/sighting.h"

namespace tern {

/// The share of a predicted box, about its centre, in which it is looked for: its edges may be elsewhere.
inline constexpr double kLookedForShare = 0.7;
/// A frame looked for a track in vain if at least kFewestLooks of 27 points are in view. At least this share
/// of those in view must be seen through.
inline constexpr int kFewestLooks = 4;
inline constexpr double kThroughShare = 0.4;
/// True if a frame looked for the box and did not find it.
bool is_looked_through(const SensorView& view, const Box& box);

}  // namespace tern
