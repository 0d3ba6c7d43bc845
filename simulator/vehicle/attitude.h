// The attitude of a multirotor that follows a motion.
#pragma once

#include "core/base/types.h"

namespace tern {

/// Returns the rotation from B (forward, left, up) to W of a multirotor without drag. Its thrust a + g points along B's
/// z. B's x lies above the heading.
/// @param acceleration  W, m/s²
/// @param yaw           the heading, rad
/// @return the level attitude if the thrust does not point upwards: the vehicle is taken to stay upright
Eigen::Quaterniond attitude_of(const Vec3& acceleration, double yaw);

}  // namespace tern
