// Relaxed starts: with noisy predictions a start often lies inside an obstacle inflated by α. Then α is reduced. See
// docs/planner/separation.md.
#pragma once

#include <vector>

#include "planner/safety/swept_obstacles.h"

namespace tern {

struct StartClearance {
  bool relaxed = false;   ///< the α of at least one track, or the margin of a box of the map, was scaled
  bool collides = false;  ///< the start touches an obstacle even without its α or margin
};

/// Scales α of every track whose box (half-extents + α) touches the body at p at time t. Scales the margin of boxes of
/// the map alike. The factor is the largest that leaves kStartSlack of room, or 0. It is found to 1e-6 by bisection of
/// the true distance.
StartClearance clear_start(std::vector<PlanningObstacle>& obstacles, const Body& body, const Vec3& p, UTime t);

/// Confines the vehicle to its side of each static box that the body at p touches exactly, and takes that box out of
/// `obstacles`. So a vehicle that stands on its ground can leave it.
///
/// A box is touched, with its α or margin or without, if |gap| ≤ kTouchingTolerance. The gap is that between the bounds
/// of body and box along the axis on which they are farthest apart. The face on that axis separates them. The body
/// stays on its side while the centre is at least as far from the face as p. So the face takes the place of a plane,
/// and the checker tests true extrema.
/// @return the positions of the centre that are no nearer to a touched face than p, W; infinite where none is touched
Box leave_touched(std::vector<PlanningObstacle>& obstacles, const Body& body, const Vec3& p);

}  // namespace tern
