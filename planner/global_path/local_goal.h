// The local goal: the point at which the path leaves the planning sphere S (paper §4).
#pragma once

#include <vector>

#include "core/base/types.h"

namespace tern {

/// The last point at which the piecewise-linear path leaves the ball of radius r around `start`; the path's end when
/// that lies in the ball. Where the path never touches the ball (it should begin at its centre), the point of the ball
/// towards the path's first point.
/// @pre path is not empty, radius > 0.
Vec3 local_goal(const std::vector<Vec3>& path, const Vec3& start, double radius);

}  // namespace tern
