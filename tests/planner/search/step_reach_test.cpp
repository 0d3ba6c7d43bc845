#include "planner/search/step_reach.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/world/flyable.h"
#include "tests/support/flat_outputs.h"
#include "tests/support/random_splines.h"

namespace tern {
namespace {

using support::random_dynamics;
using support::random_integer;
using support::random_vector;

Limits random_limits(Rng& rng) {
  Limits limits;
  limits.v_max = Vec3::Constant(rng.uniform(1.0, 12.0));
  limits.a_max = Vec3(rng.uniform(3.0, 30.0), rng.uniform(3.0, 30.0), rng.uniform(2.0, 20.0));
  if (rng.uniform() < 0.5) limits.j_max = Vec3::Constant(rng.uniform(20.0, 300.0));
  limits.dynamics = random_dynamics(rng);
  return limits;
}

TEST(ThrustSet, BoxedLimitsImplyTheDynamics) {
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    Rng rng(seed);
    const Limits limits = random_limits(rng);
    const Limits box = per_axis_limits(limits);
    const ThrustSet set(*limits.dynamics);
    const double dt = rng.uniform(0.02, 0.6);
    ASSERT_GE(set.floor, limits.dynamics->thrust_min);
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 sign((corner & 1) != 0 ? 1.0 : -1.0, (corner & 2) != 0 ? 1.0 : -1.0, (corner & 4) != 0 ? 1.0 : -1.0);
      ASSERT_TRUE(set.contains(sign.cwiseProduct(box.a_max))) << "seed " << seed << ", corner " << corner;
    }
    // From anywhere in the set to anywhere in it, by a jerk within per_axis_limits().
    for (int k = 0; k < 50; ++k) {
      const Vec3 from = random_vector(rng, 20.0);
      const Vec3 to = from + random_vector(rng, 1.0).cwiseProduct(box.j_max) * dt;
      if (!set.contains(from) || !set.contains(to)) continue;
      ASSERT_TRUE(set.allows(from, to, dt)) << "seed " << seed;
    }
  }
}

TEST(ThrustSet, TheOctagonIsInsideTheConeAndLosesNoMoreThanItSays) {
  for (int k = 0; k < 3600; ++k) {
    const double angle = k * M_PI / 1800.0;
    const double norm = octagon_norm(std::cos(angle), std::sin(angle));
    ASSERT_GE(norm, 1.0 - 1e-15);
    ASSERT_LE(norm, 1.0 / std::cos(M_PI / 8.0) + 1e-15);
  }
}

TEST(ThrustSet, WithoutDynamicsLimitsStayAsTheyAre) {
  const Limits limits;
  EXPECT_EQ(per_axis_limits(limits).a_max, limits.a_max);
  EXPECT_EQ(per_axis_limits(limits).j_max, limits.j_max);
}

/// From a start that can end at rest, random wanted steps: one can always be flown, and the end is at rest.
TEST(StepReach, WhateverIsWantedThereIsMostlyAFlyableStepUntilRest) {
  int walks = 0;
  int bold = 0;   // of these, which went where per_axis_limits limits would not
  int ended = 0;  // of these, which found no step: the search has other children
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    Rng rng(seed);
    HorizonProblem problem;
    problem.intervals = random_integer(rng, 4, 10);
    problem.interval = Duration{random_integer(rng, 50'000, 400'000)};
    problem.plan_limits = random_limits(rng);
    const double dt = problem.interval_s();
    if (rng.uniform() < 0.7) problem.start.v = random_vector(rng, 0.8 * problem.plan_limits.v_max.x());
    StepReach reach;
    reach.assign(problem);
    const Points3 first = start_control_points(problem.start, dt);
    Points q(3, problem.intervals + 3);
    q.leftCols<3>() = first;
    Vec3 v = problem.start.v;
    Vec3 a = problem.start.a;
    if (const auto steps = reach.from(1, v, a);
        steps.steady[0].empty() || steps.steady[1].empty() || steps.steady[2].empty())
      continue;
    ++walks;
    const Limits box = per_axis_limits(problem.plan_limits);
    bool outside = false;
    bool found = true;
    for (int l = 1; l < problem.intervals; ++l) {
      const StepReach::Steps steps = reach.from(l, v, a);
      Vec3 wanted;
      for (int axis = 0; axis < 3; ++axis) {
        const auto& range = steps.range[static_cast<std::size_t>(axis)];
        ASSERT_FALSE(range.empty()) << "seed " << seed << ", step " << l;
        wanted[axis] =
            rng.uniform() < 0.6 ? (rng.uniform() < 0.5 ? range.low : range.high) : rng.uniform(range.low, range.high);
      }
      const auto next = reach.flyable(steps, wanted);
      found = next.has_value();
      if (!found) break;
      a = (*next - v) / dt;
      v = *next;
      outside = outside || (a.cwiseAbs() - box.a_max).maxCoeff() > 1e-6;
      q.col(l + 2) = q.col(l + 1) + v * dt;
    }
    if (!found) {
      ++ended;
      continue;
    }
    bold += outside ? 1 : 0;
    ASSERT_LE(v.norm(), 1e-7) << "seed " << seed;
    q.rightCols<3>() = q.col(problem.intervals).replicate(1, 3);
    const TimedSpline plan{UTime{0}, problem.interval, q};
    const BreachReport report =
        breach_of(plan, plan.start, problem.start, problem.plan_limits, Box(Vec3::Constant(-1e4), Vec3::Constant(1e4)));
    // Velocities between control points may exceed v_max if the start drives them there.
    ASSERT_TRUE(report.ok() || report.breach == Breach::Velocity) << "seed " << seed << ": " << report.text();
    ASSERT_TRUE(support::flat_outputs(plan.spline()).within(*problem.plan_limits.dynamics, 1e-5)) << "seed " << seed;
  }
  EXPECT_GT(walks, 500);
  EXPECT_LT(ended, walks / 8);
  EXPECT_GT(bold, 300);
}

TEST(AxisReach, OneStepByTheSameLimitsBeforeTheRestIsTheSame) {
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    Rng rng(seed);
    const int intervals = random_integer(rng, 4, 12);
    const double dt = rng.uniform(0.03, 0.5);
    const double v_max = rng.uniform(0.5, 8.0);
    const double a_max = rng.uniform(1.0, 25.0);
    const double j_max = rng.uniform(5.0, 200.0);
    const AxisReach rest(intervals, dt, v_max, a_max, j_max);
    AxisReach step;
    step.assign_before(rest, a_max, j_max);
    const int l = random_integer(rng, 1, intervals - 1);
    const double v = rng.uniform(-v_max, v_max);
    const double a = rng.uniform(-a_max, a_max);
    EXPECT_EQ(step.next_velocity(l, v, a).low, rest.next_velocity(l, v, a).low) << "seed " << seed;
    EXPECT_EQ(step.next_velocity(l, v, a).high, rest.next_velocity(l, v, a).high) << "seed " << seed;
    EXPECT_LE(step.displacement(std::max(l, 2), v).high, rest.displacement(std::max(l, 2), v).high + 1e-9);
  }
}

}  // namespace
}  // namespace tern
