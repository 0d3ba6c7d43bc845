#include "executor/committed_heading.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"
#include "core/world/thrust.h"
#include "executor/yaw_follower.h"

namespace tern {
namespace {

constexpr UTime kZero{1'700'000'000'000'000};
constexpr Duration kPeriod{50'000};

/// The k-th plan answers the request of its number, and starts k periods after kZero.
struct Answer {
  Plan plan;
  UTime t_s;
};

Answer answer(int k) {
  Answer a;
  a.t_s = kZero + kPeriod * k;
  a.plan.request_id = k;
  a.plan.inputs.request = {1, k};
  a.plan.outcome = PlanOutcome::Optimized;
  a.plan.trajectory.start = a.t_s;
  return a;
}

/// From `from` to `to`, at rate 0 at both ends.
PlanHeading turning(const Answer& a, double from, double to) {
  PlanHeading heading;
  heading.request_id = a.plan.request_id;
  heading.request = a.plan.inputs.request;
  heading.start = a.t_s;
  const double mid = 0.5 * (from + to);
  heading.control_points = {from, from, from, mid, to, to, to};
  return heading;
}

class CommittedHeadingTest : public ::testing::Test {
 protected:
  HeadingVerdict offer(const PlanHeading& heading) {
    return committed_.consider(heading, heading.start - Duration{5'000}).verdict;
  }
  void adopt(const Answer& a) { committed_.on_adopted(a.plan, a.t_s); }

  CommittedHeading committed_{HeadingLimits{}};
};

TEST_F(CommittedHeadingTest, IsAdoptedWithItsPlanAndStaysAfterItsEnd) {
  EXPECT_FALSE(committed_.sample(kZero));
  const Answer a = answer(1);
  adopt(a);
  EXPECT_FALSE(committed_.sample(a.t_s));
  EXPECT_EQ(offer(turning(a, 0.2, 0.6)), HeadingVerdict::Adopted);
  EXPECT_FALSE(committed_.sample(a.t_s - Duration{1}));
  EXPECT_EQ(committed_.sample(a.t_s)->yaw, 0.2);
  const UTime turning_at = a.t_s + Duration{400'000};
  EXPECT_EQ(committed_.sample(turning_at)->yaw, HeadingSpline(turning(a, 0.2, 0.6)).sample(turning_at).yaw);
  EXPECT_EQ(committed_.sample(a.t_s + Duration{5'000'000})->yaw, 0.6);
  EXPECT_EQ(committed_.sample(a.t_s + Duration{5'000'000})->rate, 0.0);
}

TEST_F(CommittedHeadingTest, IsNotAdoptedWithoutItsPlanNorTwice) {
  EXPECT_EQ(offer(turning(answer(1), 0.0, 0.1)), HeadingVerdict::UnknownPlan);
  adopt(answer(2));
  EXPECT_EQ(offer(turning(answer(1), 0.0, 0.1)), HeadingVerdict::UnknownPlan);
  EXPECT_EQ(offer(turning(answer(2), 0.0, 0.1)), HeadingVerdict::Adopted);
  EXPECT_EQ(offer(turning(answer(2), 0.0, 0.1)), HeadingVerdict::UnknownPlan);
}

TEST_F(CommittedHeadingTest, IsRefusedAtItsStartAndOffThePlansKnots) {
  adopt(answer(1));
  EXPECT_EQ(committed_.consider(turning(answer(1), 0.0, 0.1), answer(1).t_s).verdict, HeadingVerdict::Late);
  adopt(answer(2));
  PlanHeading heading = turning(answer(2), 0.0, 0.1);
  heading.control_points.push_back(0.1);
  EXPECT_EQ(offer(heading), HeadingVerdict::OffKnots);
  adopt(answer(3));
  heading = turning(answer(3), 0.0, 0.1);
  heading.start = heading.start + Duration{1};
  EXPECT_EQ(offer(heading), HeadingVerdict::OffKnots);
}

TEST_F(CommittedHeadingTest, IsRefusedIfItBreaksALimitAndTheCountersSayWhich) {
  auto breach_of_next = [this, k = 0](auto change) mutable {
    const Answer a = answer(++k);
    adopt(a);
    PlanHeading heading = turning(a, 0.0, 0.1);
    change(heading);
    return committed_.consider(heading, kZero).breach;
  };
  EXPECT_EQ(breach_of_next([](PlanHeading& h) { h.control_points.back() = 0.11; }), HeadingBreach::End);
  EXPECT_EQ(breach_of_next([](PlanHeading& h) { h.control_points = {0, 0, 0, 5, 10, 10, 10}; }), HeadingBreach::Rate);
  EXPECT_EQ(breach_of_next([](PlanHeading& h) { h.control_points = {0, 0, 0.3, 0, 0, 0, 0}; }),
            HeadingBreach::Acceleration);
  EXPECT_EQ(breach_of_next([](PlanHeading& h) { h.control_points[3] = NAN; }), HeadingBreach::Shape);
  EXPECT_EQ(committed_.counters().of(HeadingVerdict::Unflyable), 4);
  EXPECT_EQ(committed_.counters().of(HeadingBreach::Rate), 1);
}

TEST_F(CommittedHeadingTest, MustJoinTheOneBeforeAndBeginsAnewAfterARefusal) {
  adopt(answer(1));
  ASSERT_EQ(offer(turning(answer(1), 0.0, 0.3)), HeadingVerdict::Adopted);
  adopt(answer(2));
  const auto refused = committed_.consider(turning(answer(2), 0.2, 0.3), kZero);
  EXPECT_EQ(refused.breach, HeadingBreach::Join);
  EXPECT_FALSE(committed_.sample(answer(2).t_s)) << "the yaw follows the flight";
  EXPECT_TRUE(committed_.sample(answer(2).t_s - Duration{1}));
  adopt(answer(3));
  EXPECT_EQ(offer(turning(answer(3), 2.0, 2.1)), HeadingVerdict::Adopted);
  EXPECT_EQ(committed_.counters().started_anew, 2);
}

TEST_F(CommittedHeadingTest, JoinsByWholeTurnsToo) {
  adopt(answer(1));
  ASSERT_EQ(offer(turning(answer(1), 3.0, 3.0)), HeadingVerdict::Adopted);
  adopt(answer(2));
  EXPECT_EQ(offer(turning(answer(2), 3.0 - 2.0 * M_PI, 3.0 - 2.0 * M_PI)), HeadingVerdict::Adopted);
  EXPECT_EQ(committed_.counters().started_anew, 1);
}

TEST_F(CommittedHeadingTest, GoesOnWhileTheCommittedTrajectoryIsKeptAndEndsWithAPlanThatHasNone) {
  adopt(answer(1));
  ASSERT_EQ(offer(turning(answer(1), 0.0, 0.3)), HeadingVerdict::Adopted);
  committed_.on_kept(answer(2).plan, answer(2).t_s);
  EXPECT_TRUE(committed_.sample(answer(2).t_s));
  adopt(answer(3));
  EXPECT_FALSE(committed_.sample(answer(3).t_s));
}

TEST_F(CommittedHeadingTest, ContinuesWithTheOneBeforeIfThePlanIsDropped) {
  adopt(answer(1));
  ASSERT_EQ(offer(turning(answer(1), 0.5, 0.5)), HeadingVerdict::Adopted);
  adopt(answer(2));
  ASSERT_EQ(offer(turning(answer(2), 0.5, 0.9)), HeadingVerdict::Adopted);
  committed_.drop_from(answer(2).t_s);
  EXPECT_EQ(committed_.sample(answer(2).t_s + Duration{2'000'000})->yaw, 0.5);
  committed_.clear();
  EXPECT_FALSE(committed_.sample(answer(2).t_s));
}

/// A spline that keeps the limits: the yaw at rate 0, a turn as fast as the middle allows, and back to rate 0.
PlanHeading random_heading(Rng& rng, double from, const HeadingLimits& limits) {
  PlanHeading heading = turning(answer(0), from, from + rng.uniform(-0.6, 0.6));
  while (!heading_breach(heading, limits, std::nullopt).ok()) {
    for (double& yaw : heading.control_points) yaw = from + 0.9 * (yaw - from);
  }
  return heading;
}

TEST(YawFollowerAlongAHeading, ThatItJoinsIsFlownExactlyWhateverTheSteps) {
  Rng rng(4);
  const HeadingLimits limits;
  for (int round = 0; round < 50; ++round) {
    const PlanHeading heading = random_heading(rng, rng.uniform(-3.0, 3.0), limits);
    const HeadingSpline spline(heading);
    YawFollower follower(spline.sample(kZero).yaw, kZero);
    for (UTime now = kZero; now < spline.end() + Duration{200'000};) {
      now = now + Duration{static_cast<std::int64_t>(rng.uniform(100.0, 20'000.0))};
      const YawSample planned = spline.sample(now);
      ASSERT_EQ(follower.follow(planned, now, limits), wrapped_yaw(planned.yaw)) << round;
      ASSERT_EQ(follower.rate(), planned.rate);
    }
  }
}

TEST(YawFollowerAlongAHeading, TurnsToItWithinItsLimitsAndIsThenOnIt) {
  Rng rng(5);
  const HeadingLimits limits;
  for (int round = 0; round < 50; ++round) {
    const HeadingSpline spline(random_heading(rng, 0.0, limits));
    YawFollower follower(rng.uniform(-3.1, 3.1), kZero);
    UTime now = kZero;
    double yaw = follower.yaw(), rate = 0.0;
    for (int k = 0; k < 350; ++k) {
      now = now + Duration{10'000};
      follower.follow(spline.sample(now), now, limits);
      const double mean = std::remainder(follower.yaw() - yaw, 2.0 * M_PI) / 0.01;
      ASSERT_LE(std::abs(mean), to_radians(limits.rate_max_deg_s) * (1.0 + 1e-6));
      ASSERT_LE(std::abs(follower.rate() - rate), 2.0 * to_radians(limits.acceleration_max_deg_s2) * 0.01 + 1e-9);
      yaw = follower.yaw();
      rate = follower.rate();
    }
    EXPECT_EQ(follower.yaw(), wrapped_yaw(spline.sample(now).yaw)) << round;
  }
}

TEST(YawFollowerAlongAHeading, GoesBackToTheFlightWithoutAJump) {
  YawFollower follower(0.0, kZero);
  UTime now = kZero;
  for (int k = 0; k < 100; ++k) {
    now = now + Duration{10'000};
    follower.follow(YawSample{1.0, 0.0}, now, HeadingLimits{});
  }
  const double before = follower.yaw();
  now = now + Duration{10'000};
  EXPECT_NEAR(follower.follow(Vec3(3, 0, 0), now), before, 0.01);
  for (int k = 0; k < 150; ++k) {
    now = now + Duration{10'000};
    follower.follow(Vec3(3, 0, 0), now);
  }
  EXPECT_NEAR(follower.yaw(), 0.0, 1e-6);
}

}  // namespace
}  // namespace tern
