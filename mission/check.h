// Finds the steps that a vehicle cannot fly to: outside the flight box, in an obstacle, beyond a fence.
#pragma once

#include <string>

#include "core/world/vehicle.h"
#include "core/world/voxel_map.h"
#include "mission/mission.h"

namespace tern::mission {

/// Returns which steps leave the flight box, body included: "waypoint 3 at (…) m is outside the flight box by 1.20 m on
/// z"; "" if none does. Steps that follow a track are not known before.
std::string steps_outside(const Mission& mission, const Box& flight_box, const Body& body);

/// Returns which steps are to be flown faster than the vehicle may fly: "waypoint 3 at (…) m has a speed of 10 m/s;
/// that of the vehicle is 6 m/s (uav.limits.v_max)"; "" if none is.
std::string steps_too_fast(const Mission& mission, const Limits& limits);

/// Returns which steps overlap occupied voxels, and their class: "waypoint 3 at (…) m is in fence"; "" if none does.
/// O(steps · voxels of the body).
std::string steps_blocked(const Mission& mission, const VoxelMap& map, const Body& body);

}  // namespace tern::mission
