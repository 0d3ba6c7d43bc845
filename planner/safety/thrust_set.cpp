#include "planner/safety/thrust_set.h"

#include <algorithm>
#include <cmath>

#include "planner/problem/tuning.h"

namespace tern {
namespace {

/// Corners of the box touch the border of the set; this keeps rounding from putting them outside.
constexpr double kInside = 1.0 - 1e-9;

/// Returns how far plans lower the vertical part of the thrust below g, m/s².
double dip_of(double thrust_min) { return std::min(kThrustDip * kGravity, kGravity - thrust_min); }

}  // namespace

double octagon_norm(double x, double y) {
  const double high = std::max(std::abs(x), std::abs(y));
  return high + kOctagon * std::min(std::abs(x), std::abs(y));
}

ThrustSet::ThrustSet(const Dynamics& dynamics)
    : thrust_min(dynamics.thrust_min),
      floor(kGravity - dip_of(dynamics.thrust_min)),
      thrust_max(dynamics.thrust_max),
      slope(tilt_slope(dynamics.tilt_max_deg)),
      rate(to_radians(dynamics.body_rate_max_deg_s)) {}

bool ThrustSet::contains(const Vec3& a) const {
  const double up = a.z() + kGravity;
  return up >= floor && octagon_norm(a.x(), a.y()) <= slope * up &&
         a.head<2>().squaredNorm() + up * up <= thrust_max * thrust_max;
}

/// Compares squares of the values of thrust_bounds(), because the search calls it for every child.
bool ThrustSet::allows(const Vec3& a0, const Vec3& a1, double duration_s) const {
  if (!contains(a1)) return false;
  const Vec3 f0 = a0 + Vec3(0.0, 0.0, kGravity), way = a1 - a0;
  const double squared = way.squaredNorm();
  const double s = squared > 0.0 ? std::clamp(-f0.dot(way) / squared, 0.0, 1.0) : 0.0;
  const double nearest2 = (f0 + s * way).squaredNorm();
  const double turned = rate * (1.0 + 0.5 * kLimitTolerance) * duration_s * nearest2;
  return nearest2 >= thrust_min * thrust_min && f0.cross(way).squaredNorm() <= turned * turned;
}

Limits per_axis_limits(const Limits& limits) {
  if (!limits.dynamics) return limits;
  const ThrustSet set(*limits.dynamics);
  Limits box = limits;
  const double dip = 0.5 * (kGravity - set.floor);
  const double z = std::min({limits.a_max.z(), dip, 0.5 * (set.thrust_max - kGravity)});
  const double by_tilt = set.slope * (kGravity - z) / std::sqrt(2.0);
  const double by_thrust = std::sqrt(0.5 * (set.thrust_max * set.thrust_max - (kGravity + z) * (kGravity + z)));
  const double xy = std::min(by_tilt, by_thrust);
  box.a_max = limits.a_max.cwiseMin(Vec3(xy, xy, z)) * kInside;
  box.j_max = limits.j_max.cwiseMin(Vec3::Constant(kInside * set.rate * set.floor / std::sqrt(3.0)));
  return box;
}

}  // namespace tern
