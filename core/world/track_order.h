// Which tracks matter most to the vehicle, for when not all of them fit.
#pragma once

#include <vector>

#include "core/base/types.h"
#include "core/world/track.h"

namespace tern {

/// Orders tracks by the distance from `vehicle` (W, m) to the region that each may occupy during [now, now + horizon].
/// It is 0 for those that can reach the vehicle. Ties: by the distance to it at `now`, then by id. O(n log n + pieces).
void sort_by_reach(std::vector<Track>& tracks, const Vec3& vehicle, UTime now, Duration horizon);

}  // namespace tern
