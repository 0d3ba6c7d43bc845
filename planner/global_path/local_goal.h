// The local goal: the point at which the path leaves the sphere S (paper §4).
#pragma once

#include <vector>

#include "core/base/types.h"

namespace tern {

/// Returns the last point at which the piecewise-linear path leaves the ball of this radius around `start`. If the path
/// ends in the ball, it returns the path's end. If the path never touches the ball, it returns the point of the ball
/// towards the path's first point.
/// @pre path is not empty, radius > 0
Vec3 local_goal(const std::vector<Vec3>& path, const Vec3& start, double radius);

}  // namespace tern
