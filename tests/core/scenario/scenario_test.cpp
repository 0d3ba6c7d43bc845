#include "core/scenario/scenario.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/base/random.h"

namespace tern {
namespace {

Limits limits_of(const Vec3& v, const Vec3& a, double j = std::numeric_limits<double>::infinity()) {
  return {v, a, Vec3::Constant(j)};
}

/// One axis by simulation: the largest distance that a jerk-limited rest-to-rest motion of duration T covers. Its
/// shape is known: a symmetric acceleration in half the time, integrated in small steps.
double distance_in(double time, double v_max, double a_max, double j_max) {
  const int steps = 20'000;
  const double dt = 0.5 * time / steps;
  // The ramp: jerk up, hold, jerk down; its peak acceleration is what the time allows.
  const auto peak_speed = [&](double ramp) {
    const double a = std::min(a_max, 0.5 * j_max * ramp);
    return std::isfinite(j_max) ? a * (ramp - a / j_max) : a_max * ramp;
  };
  double low = 0.0;
  double high = 0.5 * time;
  for (int i = 0; i < 100; ++i) (peak_speed(0.5 * (low + high)) <= v_max ? low : high) = 0.5 * (low + high);
  const double ramp = low;
  const double a = std::min(a_max, 0.5 * j_max * ramp);
  const double jerk_time = std::isfinite(j_max) ? a / j_max : 0.0;
  double v = 0.0;
  double x = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double t = (i + 0.5) * dt;
    double acceleration = a;
    if (t > ramp)
      acceleration = 0.0;
    else if (t < jerk_time)
      acceleration = j_max * t;
    else if (t > ramp - jerk_time)
      acceleration = j_max * (ramp - t);
    x += v * dt + 0.5 * acceleration * dt * dt;
    v += acceleration * dt;
  }
  return 2.0 * x;
}

TEST(RestToRestBound, IsTheBenchmarksNumber) {
  const Limits paper = limits_of(Vec3::Constant(6), Vec3(20, 20, 10));
  EXPECT_NEAR(rest_to_rest_bound_s(Vec3(0, 0, 1), Vec3(75, -1, 1), paper), 12.8, 1e-12);
  EXPECT_NEAR(rest_to_rest_bound_s(Vec3(0, 0, 1), Vec3(75, 0, 1), limits_of(Vec3::Constant(5), Vec3::Constant(20))),
              15.25, 1e-12);
  EXPECT_NEAR(rest_to_rest_bound_s(Vec3(0, 0, 2), Vec3(105, 0, 2), limits_of(Vec3::Constant(5), Vec3::Constant(20))),
              21.25, 1e-12);
  EXPECT_NEAR(
      rest_to_rest_bound_s(Vec3(0, 0, 2), Vec3(105, 0, 2), limits_of(Vec3::Constant(5), Vec3::Constant(20), 100)),
      21.45, 1e-9);
  EXPECT_NEAR(
      rest_to_rest_bound_s(Vec3(0, 0, 1), Vec3(75, 0, 1), limits_of(Vec3::Constant(3.5), Vec3(20, 20, 9.6), 30)), 22.11,
      5e-3);
}

TEST(RestToRestBound, IsTheTimeInWhichTheDistanceIsCovered) {
  Rng rng(4);
  for (int i = 0; i < 60; ++i) {
    const double v = rng.uniform(0.5, 8);
    const double a = rng.uniform(1, 25);
    const double j = i % 3 == 0 ? std::numeric_limits<double>::infinity() : rng.uniform(5, 200);
    const double distance = std::exp(rng.uniform(-4, 4));
    const double time =
        rest_to_rest_bound_s(Vec3::Zero(), Vec3(distance, 0, 0), limits_of(Vec3::Constant(v), Vec3::Constant(a), j));
    // The oracle's steps are time / 40,000 long, so its speed is wrong by up to the acceleration of one step.
    EXPECT_NEAR(distance_in(time, v, a, j), distance, 1e-3 * distance + a * time * time / 40'000)
        << "v " << v << " a " << a << " j " << j;
  }
}

TEST(RestToRestBound, IsTheSlowestAxisAndSymmetric) {
  const Limits limits = limits_of(Vec3(6, 2, 1), Vec3(20, 20, 10), 50);
  const Vec3 from(1, 2, 3);
  const Vec3 to(-4, 9, 2.5);
  double slowest = 0.0;
  for (int i = 0; i < 3; ++i) {
    Vec3 alone = from;
    alone[i] = to[i];
    slowest = std::max(slowest, rest_to_rest_bound_s(from, alone, limits));
  }
  EXPECT_EQ(rest_to_rest_bound_s(from, to, limits), slowest);
  EXPECT_EQ(rest_to_rest_bound_s(to, from, limits), slowest);
  EXPECT_EQ(rest_to_rest_bound_s(from, from, limits), 0.0);
}

}  // namespace
}  // namespace tern
