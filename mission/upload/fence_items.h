// The items of a MAVLink fence as fences: what ground stations send as a mission of type 1.
#pragma once

#include <vector>

#include "core/base/result.h"
#include "core/world/fence.h"
#include "mission/items.h"

namespace tern::mission {

/// Returns the fences of the items, in W. As in a plan they are unbounded in height, and altitudes do not count.
///
/// | command                                    | fence                                                             |
/// |--------------------------------------------|-------------------------------------------------------------------|
/// | NAV_FENCE_POLYGON_VERTEX_INCLUSION (5001)  | param1 consecutive items are the corners of a polygon, to stay in |
/// | NAV_FENCE_POLYGON_VERTEX_EXCLUSION (5002)  | the same, to stay out of                                          |
/// | NAV_FENCE_CIRCLE_INCLUSION (5003)          | a circle of the radius param1 (m), to stay in                     |
/// | NAV_FENCE_CIRCLE_EXCLUSION (5004)          | the same, to stay out of                                          |
/// | NAV_FENCE_RETURN_POINT (5000)              | none: the vehicle stays inside its fences                         |
///
/// Everything else is refused, with the item's number and the command's name:
/// - other commands, and groups of inclusions (param2);
/// - frames other than 0, 3, 5, 6 (latitude, longitude), 1 and 4 (W);
/// - a polygon without all its corners, or with fewer than 3 (one that crosses itself is for the caller to refuse);
/// - more than kMaxFencesPerMessage fences, or kMaxFenceCornersPerMessage corners.
Result<std::vector<Fence>> fences_of(const std::vector<Item>& items, const Site& site);

/// The largest radius of a circle, m; that of fences in files as well.
inline constexpr double kMaxUploadedRadius = 1e5;

}  // namespace tern::mission
