// What the executor promises of a vehicle that is not where it was told to be, and how it goes on from there.
#include <gtest/gtest.h>

#include "core/world/flyable.h"
#include "executor/commanded_motion.h"
#include "executor/executor.h"

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
  EXPECT_EQ(executor.promised(kZero), Vec3::Constant(0.25)) << "of the next request";
  const auto first = executor.next_request(kZero);
  executor.consider(answer(*first, PlanOutcome::KeepCommitted), kZero + kMs * 10);
  executor.set_tube(Vec3::Constant(0.6));
  EXPECT_EQ(executor.promised(first->t_s + kMs), Vec3::Constant(0.25)) << "errors that widen the tube do not excuse it";
  const auto second = executor.next_request(kZero + kMs * 50);
  EXPECT_EQ(second->tube, Vec3::Constant(0.6));
  executor.consider(answer(*second, PlanOutcome::NoPlan), kZero + kMs * 60);
  EXPECT_EQ(executor.promised(second->t_s + kMs), Vec3::Constant(0.25)) << "nothing was certified for more";
  const auto third = executor.next_request(kZero + kMs * 100);
  executor.consider(answer(*third, PlanOutcome::KeepCommitted), kZero + kMs * 110);
  EXPECT_EQ(executor.promised(third->t_s - kMs), Vec3::Constant(0.25));
  EXPECT_EQ(executor.promised(third->t_s), Vec3::Constant(0.6));
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
  EXPECT_NEAR(request->limits.v_max.x(), 4.0, 1e-9);
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
