// The odometry frame with bounded steps: the part of a correction that moves T_WO instead of the pose in O.
#pragma once

#include "core/world/frames.h"

namespace tern {

/// Returns T_WO after a correction of the newest pose in W.
///
/// If the position moves by at most max_step and the yaw by at most max_turn, T_WO stays: the pose in O is corrected.
/// Otherwise T_WO takes all of it and its epoch grows by one: position and yaw in O are the same before and after. Roll
/// and pitch are corrected in both cases, because gravity is the same in both frames.
/// @param before, after  the pose at one time, before and after the correction
OdometryOffset after_correction(const OdometryOffset& T_WO, const PoseInW& before, const PoseInW& after,
                                double max_step, double max_turn);

}  // namespace tern
