// The vehicle: its limits, its body and its state; the messages UAV_STATE, SETPOINT and VEHICLE_TRUTH.
#pragma once

#include <limits>
#include <optional>

#include "core/base/knobs.h"
#include "core/base/time.h"
#include "core/base/types.h"
#include "core/splines/clamped_spline.h"
#include "core/wire/header.h"

namespace tern {

/// The smallest limit of speed (m/s), acceleration (m/s²) and jerk (m/s³), in scenarios and messages. With smaller
/// ones, plans would take longer than messages allow, and positions would lose their digits.
inline constexpr double kMinLimit = 1e-3;
inline constexpr double kMaxSpeedLimit = 1e3;         ///< of v_max, m/s
inline constexpr double kMaxAccelerationLimit = 1e4;  ///< of a_max, m/s²

/// Standard gravity, m/s².
inline constexpr double kGravity = 9.80665;

/// The limits of a multirotor's propellers and attitude control; thrust is per mass. The defaults are a
/// thrust-to-weight ratio of 2 and the bounds of PX4 (MPC_THR_MIN, MPC_TILTMAX_AIR, MC_ROLLRATE_MAX). The ranges keep
/// thrust_min < g < thrust_max, so that the vehicle can hover.
struct Dynamics {
  double thrust_min = 2.4;             ///< m/s²
  double thrust_max = 19.6;            ///< m/s²
  double tilt_max_deg = 45.0;          ///< angle between thrust and vertical, degrees
  double body_rate_max_deg_s = 220.0;  ///< how fast the thrust's direction turns (roll and pitch together), degrees/s

  static constexpr Range kThrustMin{0.0, 9.0}, kThrustMax{10.5, kMaxAccelerationLimit}, kTilt{1.0, 85.0},
      kBodyRate{1.0, 1e5};
  template <typename V>
  void visit(V& v) {
    v("thrust_min", thrust_min, kThrustMin, "least thrust per mass in flight, m/s²");
    v("thrust_max", thrust_max, kThrustMax, "largest thrust per mass, m/s²");
    v("tilt_max", tilt_max_deg, kTilt, "largest angle of the thrust from the vertical, degrees");
    v("body_rate_max", body_rate_max_deg_s, kBodyRate, "how fast the thrust's direction may turn, degrees/s");
  }
};

/// The largest magnitudes per axis of W, each ≥ kMinLimit. Infinite jerk means that jerk is not limited.
struct Limits {
  Vec3 v_max = Vec3::Constant(6.0);                                      ///< m/s
  Vec3 a_max = Vec3(20.0, 20.0, 10.0);                                   ///< m/s²
  Vec3 j_max = Vec3::Constant(std::numeric_limits<double>::infinity());  ///< m/s³
  std::optional<Dynamics> dynamics = {};                                 ///< further limits; nullopt: none
};
/// x obeys a limit L if |x| ≤ L·(1 + kLimitTolerance). Planner, checker, executor and referee use the same rule.
inline constexpr double kLimitTolerance = 1e-6;
/// A plan joins its start if position (m), velocity (m/s) and acceleration (m/s²) agree to this per axis.
inline constexpr double kJoinTolerance = 1e-6;
/// The body may protrude from the flight box by this, m. It covers kJoinTolerance and rounding.
inline constexpr double kBoxTolerance = 1e-6;

/// The vehicle's shape conv(vertices) ⊕ ball(radius), relative to its position. It does not turn, so it must contain
/// all rotations of the vehicle. A sphere has the single vertex 0; a polytope has radius 0.
struct Body {
  Points vertices = Points::Zero(3, 1);  ///< 3×m, m ≥ 1, metres
  double radius = 0.1;                   ///< m, ≥ 0

  /// Returns the half-extents of the smallest box that is centred on the position and contains the body, m.
  [[nodiscard]] Vec3 half_extents() const;
};

/// UAV_STATE, SETPOINT, VEHICLE_TRUTH: the state as estimated, as commanded, as it really is.
struct UavState {
  Header header;
  UTime at;             ///< the time of this state, vehicle's clock
  MotionSample motion;  ///< p, v, a, j in W
  double yaw = 0.0;     ///< rad, (−π, π], about W's z from W's x
};

/// A trajectory: a clamped spline that starts at a time and rests at its last point after its end.
struct TimedSpline {
  UTime start;
  Duration interval{250'000};                  ///< Δt, > 0
  Points control_points = Points::Zero(3, 7);  ///< 3×(J+3), J ≥ 4, W, m

  [[nodiscard]] ClampedSpline spline() const { return {control_points, interval.seconds()}; }
  [[nodiscard]] UTime end() const { return start + interval * (control_points.cols() - 3); }
  /// Returns the motion at time t. @throws std::invalid_argument if t < start
  [[nodiscard]] MotionSample sample(UTime t) const { return spline().sample((t - start).seconds()); }
};

}  // namespace tern
