// Which accelerations the plans of a multirotor use: a convex set inside what Dynamics allows, for search and
// optimizer.
#pragma once

#include "core/world/thrust.h"

namespace tern {

/// With f = a + g e₃, the accelerations at the knots of a plan keep to
///
///     f_z ≥ floor ≥ thrust_min          a half-space, sufficient for |f| ≥ thrust_min (which is not convex)
///     |f| ≤ thrust_max                  a ball
///     ‖f_xy‖₈ ≤ tan(tilt_max) f_z       ‖(x, y)‖₈ = max + (√2 − 1) min of |x|, |y|
///
/// The last is a regular octagon with corners on the axes, inside the cone. It loses 7.6 % (1 − cos 22.5°) midway
/// between corners.
///
/// Between knots the acceleration is a weighted mean of theirs, so the whole plan keeps to the set. The floor is
/// thrust_min or g/2, whichever is more: body rates are |j_⊥|/|f|, and who falls freely cannot turn.
struct ThrustSet {
  double least, floor, ceiling, slope, rate;  ///< m/s² (three), 1, rad/s

  explicit ThrustSet(const Dynamics& dynamics);

  [[nodiscard]] bool contains(const Vec3& a) const;
  /// Whether an interval from a0 to a1 may be flown: a1 is in the set and the exact body rate within its limit.
  [[nodiscard]] bool allows(const Vec3& a0, const Vec3& a1, double duration_s) const;
};

/// tan 22.5° = √2 − 1.
inline constexpr double kOctagon = 0.41421356237309503;
/// ‖(x, y)‖₈ ≥ ‖(x, y)‖₂.
double octagon_norm(double x, double y);

/// Limits per axis from which the dynamics follow. All corners of the box of accelerations lie in the ThrustSet. No
/// jerk of the box turns an f above the floor faster than body_rate_max: √3 j ≤ rate · floor. Without dynamics the same
/// limits. What is planned by these can always be flown; what is flown may do more.
Limits per_axis_limits(const Limits& limits);

}  // namespace tern
