#include "planner/duration.h"

#include <algorithm>
#include <cmath>

#include "core/scenario/scenario.h"
#include "planner/problem/tuning.h"

namespace tern {

double min_time_to_rest(double d, double v0, double v_max, double a_max) {
  const double stop = v0 * std::abs(v0) / (2.0 * a_max);
  const double sign = d >= stop ? 1.0 : -1.0;
  const double way = sign * d;
  const double v = sign * v0;
  const double peak = std::sqrt(std::max(0.0, a_max * way + 0.5 * v * v));
  if (peak <= v_max) return (2.0 * peak - v) / a_max;
  const double ramps = std::abs(v_max - v) / a_max + v_max / a_max;
  const double ramp_way = 0.5 * (v_max + v) * std::abs(v_max - v) / a_max + 0.5 * v_max * v_max / a_max;
  return ramps + std::max(0.0, way - ramp_way) / v_max;
}

namespace {

double axis_duration(int axis, const MotionSample& start, double d, const Limits& limits) {
  const double a = limits.a_max[axis];
  const double time = min_time_to_rest(d, start.v[axis], limits.v_max[axis], a);
  if (!std::isfinite(limits.j_max[axis])) return time;
  const double peak = std::min(limits.v_max[axis], std::sqrt(a * std::abs(d) + 0.5 * start.v[axis] * start.v[axis]));
  return time + std::min(a / limits.j_max[axis], std::sqrt(peak / limits.j_max[axis]));
}

/// Returns the time to brake to rest and then to fly on, or back, to d, s.
double stop_and_go(int axis, const MotionSample& start, double d, const Limits& limits) {
  const double v_max = limits.v_max[axis];
  const double a = limits.a_max[axis];
  const double j = limits.j_max[axis];
  const RampUp stop = ramp_up(std::abs(start.v[axis]), a, j);
  const double rest = std::abs(d - std::copysign(stop.distance, start.v[axis]));
  return stop.time + rest_to_rest_s(rest, v_max, a, j);
}

}  // namespace

double min_duration(const MotionSample& start, const Vec3& to, const Limits& limits) {
  double least = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    least = std::max(least, axis_duration(axis, start, to[axis] - start.p[axis], limits));
  }
  return least;
}

Limits paced(const Limits& limits, double metres) {
  Limits paced = limits;
  for (int axis = 0; axis < 3; ++axis) {
    const double j = limits.j_max[axis];
    if (!std::isfinite(j)) continue;
    const double reached = 0.25 * j * std::cbrt(32.0 * std::max(metres, kMinPacedLength) / j);
    if (reached < kGentleShare * limits.a_max[axis]) paced.a_max[axis] = reached;
  }
  return paced;
}

double planned_duration(const MotionSample& start, const Vec3& to, const Limits& limits) {
  const Limits pace = paced(limits, (to - start.p).norm());
  double planned = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double d = to[axis] - start.p[axis];
    double time = axis_duration(axis, start, d, pace);
    if (std::isfinite(limits.j_max[axis])) time = std::min(time, stop_and_go(axis, start, d, limits));
    planned = std::max(planned, time);
  }
  return planned;
}

}  // namespace tern
