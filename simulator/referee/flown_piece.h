// A cubic piece of the vehicle's true motion, in world time.
#pragma once

#include "core/splines/piecewise_cubic.h"

namespace tern {

/// One flown cubic in world time, s.
struct FlownPiece {
  PowerCubic coefficients = PowerCubic::Zero();  ///< powers of t − start_s, W
  double start_s = 0.0;                          ///< world time at which the cubic's parameter is 0

  [[nodiscard]] MotionSample at(double t_s) const { return sample_cubic(coefficients, t_s - start_s); }
  /// Upper bound of the speed over [t0, t1], from bounds per axis, m/s.
  [[nodiscard]] double speed_bound(double t0_s, double t1_s) const {
    return max_abs_velocity(coefficients, t0_s - start_s, t1_s - start_s).norm();
  }
  /// Upper bound of the acceleration, m/s².
  [[nodiscard]] double acceleration_bound(double t0_s, double t1_s) const {
    return max_abs_acceleration(coefficients, t0_s - start_s, t1_s - start_s).norm();
  }
};

}  // namespace tern
