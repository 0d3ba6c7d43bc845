// A start inside an obstacle inflated by its α is normal with noisy predictions: α gives way, as little as it must.
#pragma once

#include <vector>

#include "planner/safety/swept_obstacles.h"

namespace tern {

struct StartClearance {
  bool relaxed = false;   ///< some alpha_scale was lowered
  bool collides = false;  ///< the start touches an obstacle even without its α
};

/// Lowers alpha_scale of each track whose box (half-extents + α) touches the body at p at time t to the largest value
/// that leaves the body clear by kTouchingTolerance: per axis s = (|p − c| − h − body)/α, the best axis taken; the rest
/// is left as it is.
StartClearance clear_start(std::vector<PlanningObstacle>& obstacles, const Body& body, const Vec3& p, UTime t);

}  // namespace tern
