// The executor's tube for a vehicle that is off its setpoints, and how the flight continues from there.
#include <gtest/gtest.h>

#include <random>

#include "core/world/flyable.h"
#include "executor/commanded_motion.h"
#include "executor/executor.h"
#include "tests/support/straight_plan.h"

namespace tern {
namespace {

constexpr UTime kZero{1'700'000'000'000'000};
constexpr Duration kMs{1'000};

UavSpec vehicle() {
  UavSpec uav;
  uav.start = Vec3(0.0, 0.0, 1.0);
  uav.flight_box = Box(Vec3(-5.0, -10.0, 0.0), Vec3(20.0, 10.0, 5.0));
  return uav;
}

Executor flying() {
  Executor executor(vehicle(), kZero - kMs * 300);
  executor.begin(kZero);
  executor.set_mode(GoalMode::Go);
  return executor;
}

Plan answer(const HorizonRequest& request, PlanOutcome outcome) {
  Plan plan;
  plan.request_id = request.id;
  plan.outcome = outcome;
  return plan;
}

TEST(Rejoin, WhatWasPromisedIsTheTubeOfThePlanInForceNotTodays) {
  Executor executor = flying();
  executor.set_tube(Vec3::Constant(0.25));
  EXPECT_EQ(executor.tube_at(kZero), Vec3::Constant(0.25)) << "of the next request";
  const auto first = executor.next_request(kZero);
  executor.consider(answer(*first, PlanOutcome::KeepCommitted), kZero + kMs * 10);
  executor.set_tube(Vec3::Constant(0.6));
  EXPECT_EQ(executor.tube_at(first->t_s + kMs), Vec3::Constant(0.25)) << "errors that widen the tube do not excuse it";
  const auto second = executor.next_request(kZero + kMs * 50);
  EXPECT_EQ(second->tube, Vec3::Constant(0.6));
  executor.consider(answer(*second, PlanOutcome::NoPlan), kZero + kMs * 60);
  EXPECT_EQ(executor.tube_at(second->t_s + kMs), Vec3::Constant(0.25)) << "nothing was certified for more";
  const auto third = executor.next_request(kZero + kMs * 100);
  executor.consider(answer(*third, PlanOutcome::KeepCommitted), kZero + kMs * 110);
  EXPECT_EQ(executor.tube_at(third->t_s - kMs), Vec3::Constant(0.25));
  EXPECT_EQ(executor.tube_at(third->t_s), Vec3::Constant(0.6));
}

TEST(Rejoin, AShareOfTheLimitsIsAskedForButNoLessThanIsFlown) {
  Executor executor = flying();
  executor.set_tube(Vec3::Constant(0.1), 0.25);
  EXPECT_EQ(executor.next_request(kZero)->limits.v_max, 0.25 * vehicle().limits.v_max);
  UavState fast;
  fast.at = kZero + kMs * 200;
  fast.motion.p = Vec3(3.0, 0.0, 1.0);
  fast.motion.v = Vec3(4.0, 0.0, 0.0);
  executor.rejoin(fast);
  const auto request = executor.next_request(kZero + kMs * 210);
  EXPECT_GT(request->start.v.x(), 0.25 * vehicle().limits.v_max.x());
  EXPECT_GE(request->limits.v_max.x(), request->start.v.x());
  EXPECT_LE(request->limits.v_max.x(), 4.0);
  EXPECT_EQ(request->limits.v_max.y(), 0.25 * vehicle().limits.v_max.y());
}

TEST(Rejoin, OutsideTheFlightBoxItAsksForOneThatHasAWayBack) {
  Executor executor = flying();
  UavState blown_out;
  blown_out.at = kZero;
  blown_out.motion.p = Vec3(3.0, 10.4, 1.0);
  blown_out.motion.v = Vec3(0.0, 1.0, 0.0);
  executor.rejoin(blown_out);
  const auto request = executor.next_request(kZero + kMs);
  EXPECT_GE(request->flight_box.max().y(), executor.committed().sample(executor.committed().end()).p.y() + 0.1);
  EXPECT_EQ(request->flight_box.min(), vehicle().flight_box.min());
  EXPECT_EQ(request->flight_box.max().z(), 5.0);
}

// A hard acceleration near the largest speed: the plan kept the limits, and so must the braking trajectory.
TEST(Rejoin, BrakingKeepsTheLimitsOfWhoeverKeepsThem) {
  const Limits limits = vehicle().limits;
  std::mt19937 rng(1);
  std::uniform_real_distribution<double> share(-1.0, 1.0);
  for (int k = 0; k < 1'000; ++k) {
    MotionSample from;
    for (int axis = 0; axis < 3; ++axis) {
      from.a[axis] = share(rng) * limits.a_max[axis];
      from.v[axis] = share(rng) * (limits.v_max[axis] - 0.01 * std::abs(from.a[axis]));
    }
    const TimedSpline stop = braking_trajectory(from, kZero, limits);
    const ClampedSpline spline = stop.spline();
    const MotionBounds bounds = motion_bounds(spline);
    EXPECT_TRUE(spline.ends_at_rest());
    EXPECT_LT((spline.sample(0.0).v - from.v).norm() + (spline.sample(0.0).a - from.a).norm(), 1e-9);
    EXPECT_LE(bounds.v_max.cwiseQuotient(limits.v_max).maxCoeff(), 1.0 + kLimitTolerance) << from.v << "\n" << from.a;
    EXPECT_LE(bounds.a_max.cwiseQuotient(limits.a_max).maxCoeff(), 1.0 + kLimitTolerance);
    const double least_s = from.v.cwiseAbs().cwiseQuotient(limits.a_max).maxCoeff();
    EXPECT_LT((stop.end() - stop.start).seconds(), 1.4 * least_s + 0.15) << "no slower than it must be";
  }
}

TEST(Rejoin, WhatNoRequestHasToldTheVehicleIsTakenBack) {
  Executor executor = flying();
  const auto request = executor.next_request(kZero);
  ASSERT_EQ(executor.consider(straight_plan(*request, Vec3(8.0, 0.0, 1.0)), kZero + kMs * 10).verdict,
            Verdict::Adopted);
  Executor told = executor;
  EXPECT_FALSE(executor.drop_unsent_plan(request->t_s + kMs)) << "setpoints have told the vehicle of it";
  EXPECT_TRUE(executor.drop_unsent_plan(request->t_s - kMs));
  EXPECT_EQ(executor.committed().newest_start(), request->committed.start);
  EXPECT_FALSE(executor.drop_unsent_plan(request->t_s - kMs));
  ASSERT_TRUE(told.next_request(kZero + kMs * 50));
  EXPECT_FALSE(told.drop_unsent_plan(request->t_s - kMs));
}

TEST(Rejoin, BrakingKeepsTheDynamicsWhereItCan) {
  Limits limits;
  limits.dynamics.emplace();
  MotionSample from;
  from.v = Vec3(5.0, 2.0, 0.0);
  const TimedSpline stop = braking_trajectory(from, kZero, limits);
  EXPECT_TRUE(breach_of(stop.spline(), *limits.dynamics).ok()) << breach_of(stop.spline(), *limits.dynamics).text();
  EXPECT_GT(stop.end(), braking_trajectory(from, kZero, {limits.v_max, limits.a_max, limits.j_max}).end());
  from.a = Vec3(0.0, 0.0, -kGravity);  // in free fall: no dynamics hold there
  EXPECT_LT((braking_trajectory(from, kZero, limits).end() - kZero).seconds(), 5.0);
}

}  // namespace
}  // namespace tern
