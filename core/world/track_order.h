// The order of tracks by their importance for the vehicle. If not all tracks fit into a message, the last are left
// out.
#pragma once

#include <vector>

#include "core/base/types.h"
#include "core/world/track.h"

namespace tern {

/// Sorts tracks by the distance from `vehicle` (W, m) to the region that each may occupy during [now, now + horizon].
/// The distance is 0 for tracks that can reach the vehicle. Ties are resolved by the distance at `now`, then by id.
/// O(n log n + pieces).
void sort_by_reach(std::vector<Track>& tracks, const Vec3& vehicle, UTime now, Duration horizon);

}  // namespace tern
