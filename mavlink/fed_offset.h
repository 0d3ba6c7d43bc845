// How an acceleration is fed to a vehicle that integrates the acceleration of its setpoints.
#pragma once

#include "core/world/vehicle.h"

namespace tern::mavlink {

/// Gains of a Copter's level position and velocity loops.
struct CopterLoops {
  double position_p = 1.0;                     ///< PSC_NE_POS_P, 1/s
  double velocity_p = 2.0, velocity_i = 1.0;   ///< PSC_NE_VEL_P, 1/s, and PSC_NE_VEL_I, 1/s²
  double velocity_d = 0.25;                    ///< PSC_NE_VEL_D
  double error_hz = 5.0, derivative_hz = 5.0;  ///< PSC_NE_VEL_FLTE and PSC_NE_VEL_FLTD: corners of filters; 0: none
};

/// An offset of setpoints that a Copter's loops answer with a given acceleration.
///
/// A Copter follows the motion that its setpoints' acceleration leads along. So an acceleration against drag, or ahead
/// of the tilt's lag, cannot be added to theirs: it would lead the vehicle off the path. But the loops command an
/// acceleration for the distance of vehicle and setpoint. For a vehicle on its path with setpoints that are off by
/// e(t), they command, beyond the path's acceleration,
///
///     ë + K_v f + K_i ∫ f dt + K_d d,   f: low pass of ė + K_p e,   d: low pass of ḟ.
///
/// The offset is the solution e(t), from rest, for which that is the wanted acceleration u(t). Under a constant u it
/// vanishes: the integrator takes over. The loops are linear, so they correct wind and errors of u independently of it.
/// With gains for which these loops diverge, the offset begins anew at kLargest.
///
/// Source: AC_PosControl::NE_update_controller and AC_PID_2D, Copter 4.8-dev.
class FedOffset {
 public:
  static constexpr double kLargest = 5.0;  ///< m

  /// Advances by dt, s, with this acceleration (level part; W, m/s²). @return e, ė, ë; the vertical parts are zero
  const MotionSample& step(const Vec3& acceleration, const CopterLoops& loops, double dt);
  /// Begins anew, as when the first setpoint is sent.
  void reset() { *this = {}; }
  [[nodiscard]] const MotionSample& offset() const { return offset_; }

 private:
  MotionSample offset_{Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  Vec3 error_ = Vec3::Zero(), derivative_ = Vec3::Zero(), integral_ = Vec3::Zero();
};

}  // namespace tern::mavlink
