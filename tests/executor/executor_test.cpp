// The executor's rules: one request at a time, each refusal with its reason, at rest in the end after any loss.
#include "executor/executor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/base/random.h"
#include "core/wire/message_limits.h"
#include "core/world/names.h"
#include "tests/support/straight_plan.h"

namespace tern {
namespace {

constexpr UTime kZero{1'700'000'000'000'000};
constexpr Duration kMs{1'000};
const Vec3 kGoal(12.0, -3.0, 2.0);

UavSpec vehicle() {
  UavSpec uav;
  uav.start = Vec3(0.0, 0.0, 1.0);
  uav.goal = kGoal;
  uav.flight_box = Box(Vec3(-5.0, -10.0, 0.0), Vec3(20.0, 10.0, 5.0));
  return uav;
}

/// An executor that may ask from kZero on.
std::int64_t open_requests(const ExecutorCounters& c) { return c.requests - c.answered_in_time - c.unanswered; }

Executor flying(const UavSpec& uav = vehicle(), const ExecutorConfig& config = {}) {
  Executor executor(uav, kZero - kMs * 300, config);
  executor.begin(kZero);
  executor.set_mode(GoalMode::Go);
  return executor;
}

TEST(Executor, AsksNothingBeforeTheMissionWithoutAGoalOrWhenStopped) {
  Executor executor(vehicle(), kZero - kMs * 300);
  EXPECT_FALSE(executor.next_wakeup());
  EXPECT_FALSE(executor.next_request(kZero));
  executor.begin(kZero);
  EXPECT_FALSE(executor.next_request(kZero));
  executor.set_mode(GoalMode::Go);
  EXPECT_FALSE(executor.next_request(kZero - kMs));
  EXPECT_EQ(executor.next_wakeup(), kZero);
  executor.set_mode(GoalMode::Stop);
  EXPECT_FALSE(executor.next_request(kZero));
  executor.set_mode(GoalMode::Hold);
  EXPECT_TRUE(executor.next_request(kZero));
}

TEST(Executor, RequestCarriesTheStateTheLimitsAndItsTimes) {
  UavSpec uav = vehicle();
  uav.body.radius = 0.2;
  uav.limits.j_max = Vec3::Constant(40.0);
  Executor executor = flying(uav);
  const auto request = executor.next_request(kZero);
  ASSERT_TRUE(request);
  EXPECT_EQ(request->id, 1);
  EXPECT_EQ(request->t_s, kZero + kMs * 75);
  EXPECT_EQ(request->deadline, kZero + kMs * 70);
  EXPECT_EQ(request->start.p, uav.start);
  EXPECT_EQ(request->start.v, Vec3::Zero());
  EXPECT_EQ(request->limits.j_max, uav.limits.j_max);
  EXPECT_EQ(request->body.radius, 0.2);
  EXPECT_TRUE(request->flight_box.isApprox(uav.flight_box));
  EXPECT_TRUE(request->committed.spline().ends_at_rest());
}

TEST(Executor, ABodyThatTouchesItsFlightBoxDoesNotWidenItHoweverLopsided) {
  UavSpec uav = vehicle();
  uav.body.radius = 0.0;
  uav.body.vertices.resize(3, 2);
  uav.body.vertices << -0.1, 0.4, -0.2, 0.3, -0.3, 0.1;
  uav.start = uav.flight_box.min() - uav.body.vertices.rowwise().minCoeff();
  EXPECT_TRUE(flying(uav).next_request(kZero)->flight_box.isApprox(uav.flight_box));
  uav.start = uav.flight_box.max() - uav.body.vertices.rowwise().maxCoeff();
  EXPECT_TRUE(flying(uav).next_request(kZero)->flight_box.isApprox(uav.flight_box));
}

TEST(Executor, AsksAgainAfterTheAnswerButNoFasterThanItsRate) {
  Executor executor = flying();
  const auto first = executor.next_request(kZero);
  EXPECT_FALSE(executor.next_request(kZero + kMs * 60));
  EXPECT_EQ(executor.next_wakeup(), first->deadline + Duration{1});
  executor.consider(straight_plan(*first, kGoal), kZero + kMs * 10);
  EXPECT_FALSE(executor.next_request(kZero + kMs * 49));
  EXPECT_EQ(executor.next_wakeup(), kZero + kMs * 50);
  EXPECT_TRUE(executor.next_request(kZero + kMs * 50));
}

TEST(Executor, AsksAgainAfterTheDeadlineAndCountsTheUnanswered) {
  Executor executor = flying();
  const auto first = executor.next_request(kZero);
  EXPECT_FALSE(executor.next_request(first->deadline));
  const auto second = executor.next_request(first->deadline + Duration{1});
  ASSERT_TRUE(second);
  EXPECT_EQ(second->id, 2);
  EXPECT_EQ(executor.counters().unanswered, 1);
}

TEST(Executor, AtRestAtTheGoalItGoesOnAsking) {
  UavSpec uav = vehicle();
  uav.goal = uav.start;
  Executor executor = flying(uav);
  for (int k = 0; k < 10; ++k) {
    const auto request = executor.next_request(kZero + kMs * 50 * k);
    ASSERT_TRUE(request);
    const Plan plan = straight_plan(*request, uav.start);
    EXPECT_EQ(executor.consider(plan, kZero + kMs * (50 * k + 5)).verdict, Verdict::Kept);
  }
  EXPECT_EQ(executor.counters().answered_in_time, 10);
}

TEST(Executor, AdoptsAPlanFromItsStartTimeOn) {
  Executor executor = flying();
  const auto request = executor.next_request(kZero);
  const Plan plan = straight_plan(*request, kGoal);
  EXPECT_EQ(executor.consider(plan, request->deadline).verdict, Verdict::Adopted);
  EXPECT_EQ(executor.sample(request->t_s).p, vehicle().start);
  EXPECT_FALSE(executor.at_rest(request->t_s));
  EXPECT_EQ(executor.sample(plan.trajectory.end()).p, Vec3(plan.trajectory.control_points.rightCols<1>()));
  EXPECT_TRUE(executor.at_rest(plan.trajectory.end()));
}

/// One way to break a plan, and the verdict that it must get.
struct Breakage {
  const char* name;
  Breach breach;
  std::function<void(Plan&, const HorizonRequest&)> apply;
};

const Breakage kBreakages[] = {
    {"too few intervals", Breach::Shape,
     [](Plan& p, const HorizonRequest&) { p.trajectory.control_points = Points::Zero(3, 6); }},
    {"too many intervals", Breach::Shape,
     [](Plan& p, const HorizonRequest&) { p.trajectory.control_points = Points::Zero(3, kMaxIntervals + 4); }},
    {"no interval length", Breach::Shape, [](Plan& p, const HorizonRequest&) { p.trajectory.interval = {0}; }},
    {"endless interval", Breach::Shape,
     [](Plan& p, const HorizonRequest&) { p.trajectory.interval = {std::numeric_limits<std::int64_t>::max()}; }},
    {"not a number", Breach::Shape,
     [](Plan& p, const HorizonRequest&) { p.trajectory.control_points(1, 5) = std::nan(""); }},
    {"starts later", Breach::Start, [](Plan& p, const HorizonRequest&) { p.trajectory.start.us += 1; }},
    {"position gap", Breach::Join,
     [](Plan& p, const HorizonRequest&) { p.trajectory.control_points.col(0).x() += 1.1e-6; }},
    {"velocity gap", Breach::Join,
     [](Plan& p, const HorizonRequest&) { p.trajectory.control_points.col(1).y() += 1e-6; }},
    {"acceleration gap", Breach::Join,
     [](Plan& p, const HorizonRequest&) { p.trajectory.control_points.col(2).z() += 1e-6; }},
    {"does not end at rest", Breach::End,
     [](Plan& p, const HorizonRequest&) { p.trajectory.control_points.rightCols<1>().x() += 1e-9; }},
    {"too fast", Breach::Velocity,
     [](Plan& p, const HorizonRequest& r) {
       HorizonRequest wide = r;
       wide.limits = {r.limits.v_max * 1.2, r.limits.a_max * 2.0, r.limits.j_max};
       p = straight_plan(wide, Vec3(19.0, 0.0, 1.0), {.intervals = 10, .reach_m = 19.0, .limit_share = 1.0});
     }},
    {"accelerates too much", Breach::Acceleration,
     [](Plan& p, const HorizonRequest& r) {
       HorizonRequest wide = r;
       wide.limits.a_max *= 1.5;
       wide.limits.j_max *= 100.0;
       p.trajectory = straight_plan(wide, r.start.p + Vec3(2.0, 0.0, 0.0)).trajectory;
     }},
    {"jerks too much", Breach::Jerk,
     [](Plan& p, const HorizonRequest& r) {
       HorizonRequest wide = r;
       wide.limits.j_max *= 1.5;
       p.trajectory = straight_plan(wide, r.start.p + Vec3(0.1, 0.0, 0.0)).trajectory;
     }},
    {"leaves the flight box", Breach::FlightBox,
     [](Plan& p, const HorizonRequest& r) {
       p = straight_plan(r, Vec3(0.0, 9.95, 1.0), {.intervals = 10, .reach_m = 20.0, .limit_share = 0.9});
     }},
};

TEST(Executor, NoRequestIsFasterThanTheSpeedLimit) {
  Executor executor = flying();
  const Vec3 slow(1.0, 1.0, 50.0);
  executor.set_speed_limit(slow);
  const auto first = executor.next_request(kZero);
  EXPECT_EQ(first->limits.v_max, vehicle().limits.v_max.cwiseMin(slow)) << "never above the vehicle's own";
  executor.set_speed_limit(std::nullopt);
  (void)executor.consider(straight_plan(*first, kGoal), kZero + kMs * 20);
  UTime now = first->deadline + kMs * 1;
  const auto fast = executor.next_request(now);
  const Plan plan = straight_plan(*fast, kGoal);
  ASSERT_EQ(executor.consider(plan, now + kMs * 10).verdict, Verdict::Adopted);
  executor.set_speed_limit(slow);
  bool waits = false, asks = false;
  for (now = plan.trajectory.start + kMs * 500; now < plan.trajectory.end() + kMs * 200; now = now + kMs * 10) {
    const auto request = executor.next_request(now);
    if (!request) {
      waits = waits || executor.next_wakeup() > now;
      continue;
    }
    asks = true;
    ASSERT_LE(request->limits.v_max.x(), 1.0 + 1e-6);
    ASSERT_LE(request->start.v.norm(), 1.0 + 1e-6);
  }
  EXPECT_TRUE(waits) << "while the committed trajectory is faster";
  EXPECT_TRUE(asks) << "once it has slowed down";
}

TEST(Executor, RefusesEveryBrokenPlanForItsReasonAndStaysOnItsTrajectory) {
  for (const Breakage& breakage : kBreakages) {
    SCOPED_TRACE(breakage.name);
    UavSpec uav = vehicle();
    uav.limits.j_max = Vec3::Constant(200.0);
    Executor executor = flying(uav);
    const auto request = executor.next_request(kZero);
    Plan plan = straight_plan(*request, kGoal);
    ASSERT_EQ(plan.outcome, PlanOutcome::Optimized);
    breakage.apply(plan, *request);
    const Adoption adoption = executor.consider(plan, kZero + kMs * 20);
    EXPECT_EQ(adoption.verdict, Verdict::Unflyable);
    EXPECT_EQ(to_string(adoption), std::string(to_string(breakage.breach))) << adoption.detail;
    EXPECT_FALSE(adoption.detail.empty());
    EXPECT_EQ(executor.counters().of(breakage.breach), 1);
    EXPECT_EQ(executor.counters().refused(), 1);
    EXPECT_EQ(executor.counters().answered_in_time, 1);
    EXPECT_TRUE(executor.at_rest(kZero + kMs * 10'000));
    EXPECT_EQ(executor.sample(kZero + kMs * 10'000).p, uav.start);
    EXPECT_EQ(open_requests(executor.counters()), 0);
  }
}

TEST(Executor, RefusesWhatComesAfterTheDeadlineAndSaysHowLate) {
  Executor executor = flying();
  const auto first = executor.next_request(kZero);
  EXPECT_EQ(executor.consider(straight_plan(*first, kGoal), first->deadline + Duration{1}).verdict, Verdict::Late);
  const auto second = executor.next_request(first->deadline + kMs * 2);
  EXPECT_EQ(executor.consider(straight_plan(*second, kGoal), second->t_s).verdict, Verdict::TooLate);
  EXPECT_EQ(executor.counters().late(), 2);
  EXPECT_EQ(executor.counters().unanswered, 2);
  EXPECT_EQ(executor.counters().answered_in_time, 0);
  EXPECT_TRUE(executor.at_rest(second->t_s + kMs * 5'000));
}

TEST(Executor, CountsASecondAnswerAndAnUnknownOne) {
  Executor executor = flying();
  const auto request = executor.next_request(kZero);
  Plan plan = straight_plan(*request, kGoal);
  EXPECT_EQ(executor.consider(plan, kZero + kMs * 10).verdict, Verdict::Adopted);
  EXPECT_EQ(executor.consider(plan, kZero + kMs * 11).verdict, Verdict::AnsweredTwice);
  plan.request_id = 77;
  EXPECT_EQ(executor.consider(plan, kZero + kMs * 12).verdict, Verdict::UnknownRequest);
  EXPECT_EQ(executor.counters().answered_twice(), 1);
  EXPECT_EQ(executor.counters().answered_in_time, 1);
}

TEST(Executor, KeepAndNoPlanCloseTheRequestAndAdoptNothing) {
  for (const PlanOutcome outcome : {PlanOutcome::KeepCommitted, PlanOutcome::NoPlan}) {
    Executor executor = flying();
    const auto request = executor.next_request(kZero);
    Plan plan = straight_plan(*request, kGoal);
    plan.outcome = outcome;
    const Adoption adoption = executor.consider(plan, kZero + kMs * 10);
    EXPECT_FALSE(is_refusal(adoption.verdict));
    EXPECT_EQ(open_requests(executor.counters()), 0);
    EXPECT_EQ(executor.committed().segments(), 1U);
  }
}

TEST(Executor, ToldToStopItAdoptsNothingMoreAndComesToRest) {
  Executor executor = flying();
  const auto first = executor.next_request(kZero);
  executor.consider(straight_plan(*first, kGoal), kZero + kMs * 10);
  const auto second = executor.next_request(kZero + kMs * 50);
  const UTime end = executor.committed().end();
  executor.set_mode(GoalMode::Stop);
  EXPECT_EQ(executor.consider(straight_plan(*second, kGoal), kZero + kMs * 60).verdict, Verdict::Stopped);
  EXPECT_EQ(executor.committed().end(), end);
  EXPECT_FALSE(executor.next_request(kZero + kMs * 200));
}

TEST(Executor, RefusesAConfigurationOutOfRange) {
  EXPECT_THROW(Executor(vehicle(), kZero, {.rate_hz = 0.0, .lead = kMs * 75}), std::invalid_argument);
  EXPECT_THROW(Executor(vehicle(), kZero, {.rate_hz = std::nan(""), .lead = kMs * 75}), std::invalid_argument);
  EXPECT_THROW(Executor(vehicle(), kZero, {.rate_hz = 20.0, .lead = kDeadlineLead}), std::invalid_argument);
}

/// The largest jump of p, v and a at t, without the change that the motion itself makes in 2 µs.
double jump_at(const Executor& executor, UTime t) {
  const MotionSample before = executor.sample(t - Duration{1});
  const MotionSample after = executor.sample(t + Duration{1});
  const double dt = 2e-6;
  const double p = (after.p - before.p).cwiseAbs().maxCoeff() - before.v.cwiseAbs().maxCoeff() * dt;
  const double v = (after.v - before.v).cwiseAbs().maxCoeff() - before.a.cwiseAbs().maxCoeff() * dt;
  const double j = std::max(before.j.cwiseAbs().maxCoeff(), after.j.cwiseAbs().maxCoeff());
  return std::max({p, v, (after.a - before.a).cwiseAbs().maxCoeff() - j * dt});
}

/// A flight in which answers come after random delays, twice, or never.
struct Flight {
  explicit Flight(std::uint64_t seed) : rng(seed) {}

  void run(Duration length) {
    std::optional<HorizonRequest> open;
    UTime answer_at{};
    for (UTime now = kZero; now < kZero + length; now = now + kMs) {
      if (open && now >= answer_at) {
        const Plan plan = straight_plan(*open, goal);
        const Adoption adoption = executor.consider(plan, now);
        if (adoption.verdict == Verdict::Adopted) splices.push_back(open->t_s);
        refused_for_content += adoption.verdict == Verdict::Unflyable ? 1 : 0;
        if (rng.uniform() < 0.1) executor.consider(plan, now);
        open.reset();
      }
      if (now >= executor.next_wakeup().value()) {
        const bool was_open = open_requests(executor.counters()) > 0;
        const std::optional<HorizonRequest> request = executor.next_request(now);
        overlaps += request && was_open && open && now <= open->deadline ? 1 : 0;
        open = rng.uniform() < 0.1 ? std::nullopt : request;
        answer_at = now + Duration::from_seconds(rng.uniform(0.0, 0.09));
      }
      ends_at_rest = ends_at_rest && executor.sample(executor.committed().end()).v.isZero() &&
                     executor.committed().in_force_at(executor.committed().end()).spline().ends_at_rest();
    }
  }

  Rng rng;
  Vec3 goal = Vec3(30.0, -8.0, 3.0);
  Executor executor = [] {
    UavSpec uav = vehicle();
    uav.flight_box = Box(Vec3::Constant(-100.0), Vec3::Constant(100.0));
    return flying(uav);
  }();
  std::vector<UTime> splices;
  int overlaps = 0, refused_for_content = 0;
  bool ends_at_rest = true;
};

TEST(Executor, WhateverIsLostLateOrRepeatedItStaysContinuousRestsInTheEndAndArrives) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE(seed);
    Flight flight(seed);
    flight.run(kMs * 20'000);
    EXPECT_EQ(flight.overlaps, 0);
    EXPECT_EQ(flight.refused_for_content, 0);
    EXPECT_TRUE(flight.ends_at_rest);
    EXPECT_GT(flight.splices.size(), 20U);
    for (const UTime t : flight.splices) EXPECT_LE(jump_at(flight.executor, t), 4.0 * kJoinTolerance);
    const ExecutorCounters& c = flight.executor.counters();
    EXPECT_TRUE(open_requests(c) == 0 || open_requests(c) == 1) << open_requests(c);
    EXPECT_GT(c.late(), 0);
    EXPECT_GT(c.answered_twice(), 0);
    EXPECT_LT((flight.executor.sample(kZero + kMs * 20'000).p - flight.goal).norm(), 1e-6);
  }
}

}  // namespace
}  // namespace tern
