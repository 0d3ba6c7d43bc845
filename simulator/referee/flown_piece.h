// A cubic piece of the vehicle's true motion, in world time.
#pragma once

#include <algorithm>
#include <optional>

#include "core/splines/piecewise_cubic.h"

namespace tern {

/// Velocities at the ends of a piece, W, m/s, and its duration, s.
struct StatedVelocity {
  Vec3 first = Vec3::Zero(), last = Vec3::Zero();
  double duration_s = 0.0;
};

/// One flown cubic in world time, s.
struct FlownPiece {
  PowerCubic coefficients = PowerCubic::Zero();  ///< powers of t − start_s, W
  double start_s = 0.0;                          ///< world time at which the cubic's parameter is 0

  /// Set if the vehicle stated the velocities at the piece's ends: between them the velocity is linear. The cubic's own
  /// slope depends on the distance of two time stamps, which may jitter.
  std::optional<StatedVelocity> stated = {};

  [[nodiscard]] MotionSample at(double t_s) const { return sample_cubic(coefficients, t_s - start_s); }
  [[nodiscard]] Vec3 velocity(double t_s) const {
    if (!stated) return at(t_s).v;
    const double share = std::clamp((t_s - start_s) / stated->duration_s, 0.0, 1.0);
    return stated->first + share * (stated->last - stated->first);
  }
  /// Upper bound of the rate at which the position changes over [t0, t1], from bounds per axis, m/s.
  [[nodiscard]] double speed_bound(double t0_s, double t1_s) const {
    return max_abs_velocity(coefficients, t0_s - start_s, t1_s - start_s).norm();
  }
  /// Upper bound of the rate at which velocity() changes, m/s².
  [[nodiscard]] double acceleration_bound(double t0_s, double t1_s) const {
    if (stated) return (stated->last - stated->first).norm() / stated->duration_s;
    return max_abs_acceleration(coefficients, t0_s - start_s, t1_s - start_s).norm();
  }
};

}  // namespace tern
