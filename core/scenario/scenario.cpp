#include "core/scenario/scenario.h"

#include <algorithm>
#include <cmath>

namespace tern {

RampUp ramp_up(double v, double a, double j) {
  if (!std::isfinite(j)) return {v / a, 0.5 * v * v / a};
  const double time = v * j >= a * a ? v / a + a / j : 2.0 * std::sqrt(v / j);
  return {time, 0.5 * v * time};
}

double rest_to_rest_s(double distance, double v_max, double a, double j) {
  if (distance <= 0.0) return 0.0;
  const RampUp full = ramp_up(v_max, a, j);
  if (2.0 * full.distance <= distance) return 2.0 * full.time + (distance - 2.0 * full.distance) / v_max;
  double low = 0.0;
  double high = v_max;
  for (int i = 0; i < 200; ++i) {
    const double mid = 0.5 * (low + high);
    (2.0 * ramp_up(mid, a, j).distance <= distance ? low : high) = mid;
  }
  return 2.0 * ramp_up(high, a, j).time;
}

double rest_to_rest_bound_s(const Vec3& from, const Vec3& to, const Limits& limits) {
  double bound = 0.0;
  for (int i = 0; i < 3; ++i) {
    bound =
        std::max(bound, rest_to_rest_s(std::abs(to[i] - from[i]), limits.v_max[i], limits.a_max[i], limits.j_max[i]));
  }
  return bound;
}

double flight_timeout_s(const Scenario& scenario) {
  const UavSpec& uav = scenario.uav;
  return scenario.timeout_s.value_or(3.0 * rest_to_rest_bound_s(uav.start, uav.goal, uav.limits) + 10.0);
}

}  // namespace tern
