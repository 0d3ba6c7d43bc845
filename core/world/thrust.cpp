#include "core/world/thrust.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace tern {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double slope_of(const Vec3& f) { return f.z() > 0.0 ? f.head<2>().norm() / f.z() : kInfinity; }

/// Returns the distance of 0 from the segment.
double least_norm(const Vec3& from, const Vec3& to) {
  const Vec3 way = to - from;
  const double squared = way.squaredNorm();
  const double s = squared > 0.0 ? std::clamp(-from.dot(way) / squared, 0.0, 1.0) : 0.0;
  return (from + s * way).norm();
}

}  // namespace

ThrustBounds thrust_bounds(const Vec3& a0, const Vec3& a1, double duration_s) {
  const Vec3 f0 = a0 + Vec3(0.0, 0.0, kGravity);
  const Vec3 f1 = a1 + Vec3(0.0, 0.0, kGravity);
  ThrustBounds b;
  b.min_thrust = least_norm(f0, f1);
  b.max_thrust = std::max(f0.norm(), f1.norm());
  b.slope = std::max(slope_of(f0), slope_of(f1));
  b.body_rate = b.min_thrust > 0.0 ? f0.cross(f1).norm() / (duration_s * b.min_thrust * b.min_thrust) : kInfinity;
  return b;
}

ThrustBounds thrust_bounds(const ClampedSpline& spline, int j) {
  const PowerCubic c = spline.power(j);
  const double dt = spline.interval_s();
  const Vec3 a0 = 2.0 * c.col(1) / (dt * dt);
  return thrust_bounds(a0, a0 + 6.0 * c.col(0) / (dt * dt), dt);
}

double tilt_slope(double tilt_deg) { return std::tan(to_radians(tilt_deg)); }
double to_degrees(double rad) { return rad * (180.0 / M_PI); }
double to_radians(double deg) { return deg * (M_PI / 180.0); }

}  // namespace tern
