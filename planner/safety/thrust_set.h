// The accelerations that plans of a multirotor use: a convex set inside the limits of Dynamics, for search and
// optimizer. See docs/planner/search.md.
#pragma once

#include "core/world/thrust.h"

namespace tern {

/// A convex set of accelerations a. With the thrust per mass f = a + g e₃:
///
///     f_z ≥ floor ≥ thrust_min          a half-space; it implies |f| ≥ thrust_min, which is not convex
///     |f| ≤ thrust_max                  a ball
///     ‖f_xy‖₈ ≤ tan(tilt_max) f_z       ‖(x, y)‖₈ = max(|x|, |y|) + (√2 − 1) min(|x|, |y|)
///
/// The last one is a regular octagon inside the cone of allowed tilts, with corners on the axes. Midway between corners
/// it loses 7.6 % (1 − cos 22.5°).
///
/// Plans keep the accelerations at their knots in the set. Between knots the acceleration is a weighted mean of these,
/// so the whole plan stays in the set. The floor is max(thrust_min, g/2): the body rate is |j_⊥|/|f|, so a vehicle in
/// free fall cannot turn.
struct ThrustSet {
  double thrust_min, floor, thrust_max;  ///< m/s²
  double slope;                          ///< tan(tilt_max)
  double rate;                           ///< largest body rate, rad/s

  explicit ThrustSet(const Dynamics& dynamics);

  [[nodiscard]] bool contains(const Vec3& a) const;
  /// Returns whether an interval from a0 to a1 can be flown: a1 is in the set, and exact thrust and body rate keep
  /// their limits.
  [[nodiscard]] bool allows(const Vec3& a0, const Vec3& a1, double duration_s) const;
};

/// tan 22.5° = √2 − 1.
inline constexpr double kOctagon = 0.41421356237309503;
/// Returns ‖(x, y)‖₈, which is at least ‖(x, y)‖₂.
double octagon_norm(double x, double y);

/// Returns limits per axis that imply the dynamics; without dynamics it returns the limits unchanged.
///
/// All corners of the box of accelerations are in the ThrustSet. A jerk within the box turns an f above the floor no
/// faster than body_rate_max: √3 j ≤ rate · floor. A plan within these limits can always be flown; a flyable plan may
/// exceed them.
Limits per_axis_limits(const Limits& limits);

}  // namespace tern
