#include "core/scenario/step_aside.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/random.h"

namespace tern {
namespace {

constexpr int kMaxMovers = 5;
constexpr double kLastTouch = kStepAsideQuiet + 4.0;  // s

double log_uniform(Rng& rng, double low, double high) { return low * std::pow(high / low, rng.uniform()); }

Limits draw_limits(Rng& rng) {
  Limits limits;
  limits.v_max = Vec3::Constant(log_uniform(rng, 0.5, 6.0));
  const double a = log_uniform(rng, 1.0, 20.0);
  limits.a_max = Vec3(a, a, 0.5 * a);
  const bool has_jerk_limit = rng.uniform() >= 0.2;
  const double j = log_uniform(rng, 5.0, 200.0);
  limits.j_max = Vec3::Constant(has_jerk_limit ? j : std::numeric_limits<double>::infinity());
  return limits;
}

Vec3 draw_direction(Rng& rng) {
  const double z = rng.uniform(-1.0, 1.0);
  const double azimuth = rng.uniform(0.0, 2.0 * std::numbers::pi);
  const double r = std::sqrt(1.0 - z * z);
  return {r * std::cos(azimuth), r * std::sin(azimuth), z};
}

/// Returns the first time (s, ≤ 0) at which a box contains a point. The box moves at v; at time 0 its centre is at
/// `offset` from the point.
double entry(const Vec3& offset, const Vec3& half, const Vec3& v) {
  double latest = -std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    if (v[axis] == 0.0) continue;
    latest = std::max(latest, (-std::copysign(half[axis], v[axis]) - offset[axis]) / v[axis]);
  }
  return latest;
}

ObstacleSpec draw_mover(Rng& rng, const Vec3& start, double v_max, double radius) {
  ObstacleSpec mover;
  for (int axis = 0; axis < 3; ++axis) mover.half_extents[axis] = log_uniform(rng, 0.1, 1.5);
  const Vec3 direction = draw_direction(rng);
  const Vec3 v = direction * log_uniform(rng, 0.4, 2.0 * v_max);
  const Vec3 reach = mover.half_extents + Vec3::Constant(radius);
  Vec3 offset;
  for (int axis = 0; axis < 3; ++axis) offset[axis] = rng.uniform(-1.0, 1.0) * reach[axis];
  const double touches_at = rng.uniform(kStepAsideQuiet, kLastTouch);
  mover.centre = start + offset - v * (touches_at - entry(offset, reach, v));
  mover.motion = LinearMotion{v, 0.0};
  return mover;
}

}  // namespace

StepAside draw_step_aside(std::uint64_t seed, const Vec3& start) {
  Rng rng(seed);
  StepAside drawn;
  drawn.limits = draw_limits(rng);
  drawn.body.radius = log_uniform(rng, 0.1, 0.4);
  const int movers = 1 + static_cast<int>(kMaxMovers * rng.uniform());
  for (int k = 0; k < movers; ++k) {
    drawn.movers.push_back(draw_mover(rng, start, drawn.limits.v_max.x(), drawn.body.radius));
  }
  return drawn;
}

}  // namespace tern
