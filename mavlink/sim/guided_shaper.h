// How ArduPilot's Copter shapes the setpoints of GUIDED before its position controller follows them.
#pragma once

#include "core/world/vehicle.h"

namespace tern::mavlink {

/// Limits of the shaping in one direction.
struct ShapingLimits {
  double acceleration = 2.5;  ///< of corrections, m/s²
  double jerk = 5.0;          ///< of the sum of setpoint and corrections, m/s³
};

/// The motion that the position controller follows. It approaches the setpoint (p, v, a): with e = p − p_d and
/// k = jerk/acceleration, its acceleration a_d goes at most `jerk` per second towards
///
///     a + limited(k·(v + c(e) − v_d)),   c(e) = k·e near the setpoint, √(2·acceleration·|e| − …) farther away.
///
/// Where the setpoint's a is the derivative of its v, and that changes by less than `jerk`, p_d is p. Otherwise p_d is
/// apart: a constant addition b to a shifts p_d by b/k².
///
/// Source: AP_Math's shape_pos_vel_accel_xy and shape_pos_vel_accel, Copter 4.8-dev. Left out: the limit of the
/// correcting speed (WP_SPD), which is far above that of a vehicle that follows.
class GuidedShaper {
 public:
  /// Begins at this state, as when the first setpoint arrives.
  void restart(const MotionSample& here) { desired_ = here; }
  /// Advances by dt (s), towards a setpoint. @return the motion to follow; its j is zero
  const MotionSample& step(const MotionSample& setpoint, const ShapingLimits& level, const ShapingLimits& up,
                           double dt);

 private:
  MotionSample desired_;
};

}  // namespace tern::mavlink
