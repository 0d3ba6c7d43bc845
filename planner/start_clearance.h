// Relaxed starts: with noisy predictions a start often lies inside an obstacle inflated by α. Then α is reduced. See
// docs/planner/separation.md.
#pragma once

#include <vector>

#include "planner/safety/swept_obstacles.h"

namespace tern {

struct StartClearance {
  bool relaxed = false;   ///< the α of at least one track was scaled
  bool collides = false;  ///< the start touches an obstacle even without its α
};

/// Scales α of every track whose box (half-extents + α) touches the body at p at time t; other obstacles stay as they
/// are. The factor is the largest that leaves kStartSlack of room, or 0. It is found to 1e-6 by bisection of the true
/// distance.
StartClearance clear_start(std::vector<PlanningObstacle>& obstacles, const Body& body, const Vec3& p, UTime t);

}  // namespace tern
