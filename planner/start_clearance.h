// A start inside an obstacle inflated by its α is normal with noisy predictions: α is scaled, as little as it must be.
#pragma once

#include <vector>

#include "planner/safety/swept_obstacles.h"

namespace tern {

struct StartClearance {
  bool relaxed = false;   ///< some track's α was scaled
  bool collides = false;  ///< the start touches an obstacle even without its α
};

/// Where the body at p touches a track's box (half-extents + α) at time t, what counts of its α is scaled. The factor
/// is the largest one that leaves a millimetre of room, to 1e-6 by bisection of the true distance, or 0. The other
/// obstacles are left as they are.
StartClearance clear_start(std::vector<PlanningObstacle>& obstacles, const Body& body, const Vec3& p, UTime t);

}  // namespace tern
