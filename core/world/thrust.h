// Thrust, tilt and body rates that a multirotor needs to fly a trajectory, by differential flatness.
//
// With the acceleration a (W) the thrust per mass is f = a + g e₃, along the body's axis z = f/|f|. The tilt is the
// angle of f from e₃. The axis turns with ż = (j − (j·z) z)/|f|. Its speed is the body rate about x and y together,
// |ω_xy| = |ż| = |f × j|/|f|²; yaw does not change it. Source: D. Mellinger and V. Kumar, "Minimum snap trajectory
// generation and control for quadrotors", ICRA 2011 (there h_ω).
//
// On an interval of a cubic spline f is linear in time and j is constant. All results are therefore exact.
#pragma once

#include "core/world/vehicle.h"

namespace tern {

/// The extrema over an interval, in which f moves from f_0 to f_1 in the time Δt.
struct ThrustBounds {
  double min_thrust = 0.0;  ///< min |f|, m/s²: the distance of 0 from the segment f_0 f_1
  double max_thrust = 0.0;  ///< max |f|, m/s²: it lies at an end
  double slope = 0.0;       ///< tan of the largest tilt, |f_xy|/f_z at an end (cones are convex); ∞ from 90° on
  double body_rate = 0.0;   ///< |f_0 × f_1|/(Δt min_thrust²), rad/s, since f × j is constant; ∞ if min_thrust = 0
};

/// Returns the extrema between two accelerations (m/s²) that are duration_s = Δt > 0 apart.
ThrustBounds thrust_bounds(const Vec3& a0, const Vec3& a1, double duration_s);
/// Returns the extrema on interval j of a spline.
ThrustBounds thrust_bounds(const ClampedSpline& spline, int j);

/// Returns the tangent of a tilt in [0°, 90°).
double tilt_slope(double tilt_deg);
double to_degrees(double rad);
double to_radians(double deg);

}  // namespace tern
