// How ArduPilot's Copter follows the motion that GuidedShaper leads along, levelly.
#pragma once

#include "core/world/vehicle.h"
#include "mavlink/fed_offset.h"

namespace tern::mavlink {

/// Copter's level loops: position P, then velocity PID on filtered errors. The tilt follows their acceleration through
/// its command model: two first-order lags of ATC_INPUT_TC each.
///
/// Source: AC_PosControl::NE_update_controller, AC_PID_2D, AC_AttitudeControl::attitude_command_model, Copter 4.8-dev.
/// Left out: the limits of corrections, of the integrator, and of the tilt's rates.
class GuidedLoops {
 public:
  /// Begins with filters at rest.
  void restart() { *this = {}; }
  /// Advances by dt, s. @param input_tc  ATC_INPUT_TC, s
  /// @return a command: level place and velocity of the estimate, the level acceleration to tilt for, and the desired
  ///   vertical motion
  MotionSample step(const MotionSample& desired, const MotionSample& estimate, const CopterLoops& loops,
                    double input_tc, double dt);

 private:
  bool started_ = false;
  Vec3 error_ = Vec3::Zero(), derivative_ = Vec3::Zero(), integral_ = Vec3::Zero();
  Vec3 tilted_ = Vec3::Zero(), tilting_ = Vec3::Zero();
};

}  // namespace tern::mavlink
