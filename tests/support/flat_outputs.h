// Oracle: thrust, tilt and body rates that a multirotor needs to fly a spline, by dense sampling.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/base/random.h"
#include "core/world/vehicle.h"

namespace tern::support {

/// Extrema over the samples; between samples the values may be slightly larger.
struct FlatOutputs {
  double min_thrust = 1e9, max_thrust = 0.0;  ///< thrust per mass, m/s²
  double tilt_deg = 0.0, rate_deg_s = 0.0;    ///< of the thrust's direction; the rate from sample to sample

  /// True if the values exceed the limits of `d` by at most this share of each limit.
  [[nodiscard]] bool within(const Dynamics& d, double share) const {
    return min_thrust >= d.thrust_min * (1.0 - share) && max_thrust <= d.thrust_max * (1.0 + share) &&
           tilt_deg <= d.tilt_max_deg * (1.0 + share) && rate_deg_s <= d.body_rate_max_deg_s * (1.0 + share);
  }
};

inline FlatOutputs flat_outputs(const ClampedSpline& spline, int samples_per_interval = 200) {
  FlatOutputs out;
  const double step = spline.interval_s() / samples_per_interval;
  Vec3 before = Vec3::Zero();
  for (int k = 0; k <= samples_per_interval * spline.intervals(); ++k) {
    const Vec3 thrust = spline.sample(std::min(k * step, spline.duration_s())).a + Vec3(0.0, 0.0, 9.80665);
    const Vec3 z = thrust.normalized();
    out.min_thrust = std::min(out.min_thrust, thrust.norm());
    out.max_thrust = std::max(out.max_thrust, thrust.norm());
    out.tilt_deg = std::max(out.tilt_deg, std::acos(std::clamp(z.z(), -1.0, 1.0)) * 180.0 / M_PI);
    // The chord of two unit vectors resolves small angles; their scalar product does not.
    if (k > 0)
      out.rate_deg_s = std::max(out.rate_deg_s, 2.0 * std::asin(0.5 * (z - before).norm()) * 180.0 / M_PI / step);
    before = z;
  }
  return out;
}

/// Returns dynamics between a heavy vehicle with an autopilot's defaults and a racer.
inline Dynamics random_dynamics(Rng& rng) {
  return {rng.uniform(0.0, 5.0), rng.uniform(14.0, 50.0), rng.uniform(25.0, 80.0), rng.uniform(150.0, 1200.0)};
}

}  // namespace tern::support
