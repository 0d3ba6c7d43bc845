// What a multirotor must do to fly a trajectory: thrust, tilt and body rates, by differential flatness.
//
// With the acceleration a (W) the thrust per mass is f = a + g e₃, along the body's z axis z = f/|f|. The tilt is the
// angle of f from e₃. Its direction turns with ż = (j − (j·z) z)/|f|, and |ż| is the body rate about the axes x and y
// together: |ω_xy| = |f × j|/|f|² (D. Mellinger and V. Kumar, "Minimum snap trajectory generation and control for
// quadrotors", ICRA 2011: h_ω). Yaw is free of it.
//
// On an interval of a cubic spline f is linear in time and j constant, so that everything below is exact.
#pragma once

#include "core/world/vehicle.h"

namespace tern {

/// The extrema over an interval from f_0 to f_1 in Δt.
struct ThrustBounds {
  double min_thrust = 0.0;  ///< min |f|: the distance of 0 from the segment f_0 f_1, m/s²
  double max_thrust = 0.0;  ///< max |f|: at an end, m/s²
  double slope = 0.0;       ///< tan of the largest tilt: |f_xy|/f_z at an end (cones are convex); infinite from 90° on
  double body_rate = 0.0;   ///< |f_0 × f_1|/(Δt least²): f × j is constant, rad/s; infinite where f vanishes
};

/// @param a0, a1  accelerations at the ends, m/s²; @param duration_s  Δt > 0
ThrustBounds thrust_bounds(const Vec3& a0, const Vec3& a1, double duration_s);
/// Of interval j.
ThrustBounds thrust_bounds(const ClampedSpline& spline, int j);

/// tan of a tilt in [0°, 90°).
double tilt_slope(double tilt_deg);
double to_degrees(double rad);
double to_radians(double deg);

}  // namespace tern
