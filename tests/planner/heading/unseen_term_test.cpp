#include "planner/heading/unseen_term.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "planner/heading/heading_planner.h"
#include "planner/heading/path_term.h"
#include "planner/problem/tuning.h"
#include "tests/support/corridor_frames.h"
#include "tests/support/effort.h"
#include "tests/support/planner_worlds.h"

namespace tern {
namespace {

using namespace support;

constexpr UTime kZero{1'700'000'000'000'000};
constexpr double kPi = std::numbers::pi;
constexpr double kRadius = 0.1;

/// The knowledge of one picture from p with this range by azimuth. No other space is known to be clear.
template <class Range>
UnseenKnowledge seen_from(const Vec2& p, const Range& range) {
  UnseenMovers movers;
  movers.clear_radius_m = 0.0;
  UnseenWatch watch(movers, Vec3::Zero());
  EXPECT_TRUE(watch.add(frame_at(kZero, 0, p, range)));
  return watch.knowledge();
}

std::vector<Box> upright(const Corridor& corridor) {
  std::vector<Box> boxes;
  for (const Square& wall : corridor.walls) {
    boxes.emplace_back(Vec3(wall.min().x(), wall.min().y(), 0.0), Vec3(wall.max().x(), wall.max().y(), 3.0));
  }
  return boxes;
}

std::vector<LookTarget> targets_of(const UnseenTerm& term, const Vec2& p, double speed = 0.0) {
  std::vector<LookTarget> targets;
  term.look({kZero, Vec3(p.x(), p.y(), 1.0), Vec3(speed, 0.0, 0.0)}, targets);
  return targets;
}

/// The worth of all bearings in [from, from + width].
double worth_within(const std::vector<LookTarget>& targets, double from, double width) {
  double sum = 0.0;
  for (const LookTarget& target : targets) {
    const double turn = (target.bearing - from) / (2.0 * kPi);
    if (2.0 * kPi * (turn - std::floor(turn)) < width) sum += target.worth;
  }
  return sum;
}

/// The largest distance per axis between a place and a box in the plane.
double apart(const Box& box, const Vec2& p) {
  const Vec2 low = box.min().head<2>() - p, high = p - box.max().head<2>();
  return std::max(low.maxCoeff(), high.maxCoeff());
}

/// Oracle: many bearings, short steps, and walls by looking whether the point lies in one.
double worth_by_steps(const UnseenField& field, const std::vector<Box>& boxes, const Vec2& p, double soon_s,
                      double from, double width) {
  constexpr double kBearing = kPi / 720.0, kStep = 0.01;
  const double per_m = 1.0 / (field.max_speed() * soon_s);
  double sum = 0.0;
  for (double bearing = from + 0.5 * kBearing; bearing < from + width; bearing += kBearing) {
    for (double x = kRadius + 0.5 * kStep; x < UnseenField::kFarthest; x += kStep) {
      const Vec2 at = p + x * Vec2(std::cos(bearing), std::sin(bearing));
      if (std::ranges::any_of(
              boxes, [&](const Box& b) { return apart(b, at) <= std::min(kUnseenBefore, apart(b, p) - kRadius); }))
        break;
      if (field.distance(at) > 0.5 * field.grid().cell) continue;
      sum += field.max_speed() * per_m * std::exp(-(x - kRadius) * per_m) * kStep * kBearing;
    }
  }
  return sum;
}

TEST(UnseenTerm, IsTheUrgencyOfTheHiddenPlacesThatALookCanShow) {
  Rng rng(5);
  const Limits limits;
  const double soon_s = kSightAhead + stop_time(2.0, limits);
  for (int round = 0; round < at_effort(40); ++round) {
    const Corridor corridor(rng);
    const Vec2 eye(rng.uniform(0.0, 3.0), rng.uniform(-0.5, 0.5)), p = eye + Vec2(rng.uniform(-1.0, 1.0), 0.0);
    const double blind = rng.uniform(0.0, 2.0 * kPi);
    const UnseenKnowledge known = seen_from(eye, [&](double azimuth) {
      return std::remainder(azimuth - blind, 2.0 * kPi) > 1.5 ? 0.2 : corridor.range(eye, azimuth);
    });
    const std::vector<Box> boxes = upright(corridor);
    const auto targets = targets_of(UnseenTerm(known, boxes, kRadius, limits), p, 2.0);
    const double half = kPi / kUnseenBearings;  // a bearing stands for half a step to either side
    for (int k = 0; k < 4; ++k) {
      const double from = 0.5 * kPi * k - half;
      const double slow = worth_by_steps(*known.field, boxes, p, soon_s, from, 0.5 * kPi);
      EXPECT_NEAR(worth_within(targets, from - 1e-9, 0.5 * kPi), slow, 0.05 + 0.1 * slow) << round << ' ' << k;
    }
  }
}

/// The knowledge of one picture of a corridor, by a camera at p that looks along x.
UnseenKnowledge seen_ahead(const Corridor& corridor, const Vec2& p) {
  return seen_from(p, [&](double azimuth) {
    return std::abs(std::remainder(azimuth, 2.0 * kPi)) > 0.74 ? 0.2 : corridor.range(p, azimuth);
  });
}

TEST(UnseenTerm, CountsAGapBesideTheViewMoreThanAWall) {
  Rng rng(6);
  for (int round = 0; round < 10; ++round) {
    const Corridor corridor(rng);
    const Vec2 p(corridor.gap + 0.5, 0.0);
    const UnseenKnowledge known = seen_ahead(corridor, p);
    const auto targets = targets_of(UnseenTerm(known, upright(corridor), kRadius, {}), p);
    const double left = worth_within(targets, 0.25 * kPi, 0.5 * kPi);
    const double right = worth_within(targets, 1.25 * kPi, 0.5 * kPi);
    EXPECT_GT(left, right + 0.1) << "the gap is to the left";
    EXPECT_LT(worth_within(targets, -0.3, 0.6), left) << "ahead all is seen but what is next to the vehicle";
  }
}

TEST(UnseenTerm, HasNoTargetsWhereAllIsSeen) {
  const UnseenKnowledge known = seen_from(Vec2(0, 0), [](double) { return 10.0; });
  const auto targets = targets_of(UnseenTerm(known, {}, kRadius, {}), Vec2(0, 0));
  EXPECT_EQ(targets.size(), 0U);
}

/// A flight along x at this speed that has not ended, or a rest for so long.
struct Asked {
  HorizonRequest request;
  Plan plan;
};

Asked straight(double speed) {
  TimedSpline t{kZero, Duration{300'000}, Points::Constant(3, 9, 1.0)};
  const double x[] = {0.0, 0.1, 0.3, 0.6, 0.9, 1.2, 1.4, 1.5, 1.5};
  for (int k = 0; k < 9; ++k) t.control_points.col(k) = Vec3(speed * x[k], 0.0, 1.0);
  Asked asked{request_at(kZero, t), {}};
  asked.plan.outcome = PlanOutcome::Optimized;
  asked.plan.trajectory = t;
  asked.plan.local_goal = Vec3(4, 0, 1);
  return asked;
}

Asked resting_for(double seconds) {
  TimedSpline rest = resting_at(Vec3(0, 0, 1), kZero);
  const UTime t_s = rest.end() + Duration::from_seconds(seconds);
  Asked asked{request_at(t_s, rest), {}};
  asked.plan.outcome = PlanOutcome::KeepCommitted;
  asked.plan.trajectory = rest;
  asked.plan.local_goal = Vec3(4, 0, 1);
  return asked;
}

PlanHeading heading_of(const Asked& asked, const UnseenTerm* unseen, bool around = false) {
  const HeadingStart start = heading_start({0.0, 0.0}, asked.plan.trajectory.interval);
  return plan_heading(asked.request, asked.plan, {}, {}, start, {.unseen = unseen, .looks_around = around}).value();
}

TEST(PlanHeading, TurnsTowardsTheGapOfABlindCorner) {
  Rng rng(7);
  Corridor corridor(rng);
  corridor.walls = {Square(Vec2(-20, 1.3), Vec2(-0.5, 1.5)), Square(Vec2(1.0, 1.3), Vec2(20, 1.5)),
                    Square(Vec2(-20, -1.5), Vec2(20, -1.3))};
  const UnseenKnowledge known = seen_ahead(corridor, Vec2(0, 0));
  const UnseenTerm unseen(known, upright(corridor), kRadius, {});
  const PlanHeading waits = heading_of(resting_for(0.1), &unseen, true), flies = heading_of(straight(0.5), nullptr);
  EXPECT_NEAR(flies.control_points.back(), 0.0, 1e-6);
  EXPECT_EQ(flies.unseen_term, 0.0);
  EXPECT_GT(waits.unseen_term, 0.0);
  EXPECT_GT(waits.control_points.back(), 0.4) << "the gap is to the left";
  const PlanHeading fast = heading_of(straight(4.0), &unseen);
  for (const double yaw : fast.control_points) EXPECT_LT(std::abs(yaw), 0.7) << "the way stays in view";
}

TEST(PlanHeading, OfAVehicleThatLooksAroundTurnsToWhatItHasNotSeen) {
  const Vec2 p(0, 0);
  const UnseenKnowledge known = seen_from(p, [&](double azimuth) { return std::abs(azimuth) > 0.7 ? 0.2 : 10.0; });
  const UnseenTerm unseen(known, {}, kRadius, {});
  EXPECT_GT(std::abs(heading_of(resting_for(0.2), &unseen, true).control_points.back()), 0.7);
}

TEST(LooksAround, WhileTheWaitLastsAndLooksAheadAgainBeforeItEnds) {
  for (const double wait_s : {0.5, 2.0, 4.0}) {
    for (const double rested_s : {0.0, 0.3, 0.9, 1.1, 2.5, 3.5}) {
      const Asked asked = resting_for(rested_s);
      EXPECT_EQ(looks_around(asked.request, asked.plan, wait_s), rested_s <= 0.5 * wait_s);
    }
  }
  const Asked flies = straight(1.0);
  EXPECT_FALSE(looks_around(flies.request, flies.plan, 4.0));
  Asked departs = resting_for(0.1);
  departs.plan.outcome = PlanOutcome::Optimized;
  EXPECT_FALSE(looks_around(departs.request, departs.plan, 4.0));
}

}  // namespace
}  // namespace tern
