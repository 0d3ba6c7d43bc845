#include "planner/heading/heading_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "core/base/random.h"
#include "core/world/thrust.h"
#include "core/world/vehicle.h"
#include "planner/heading/heading_planner.h"
#include "planner/problem/tuning.h"

namespace tern {
namespace {

using Targets = std::vector<std::vector<LookTarget>>;

constexpr UTime kZero{1'700'000'000'000'000};

struct Case {
  HeadingLimits limits;
  Duration interval;
  int intervals = 6;
  YawSample start;
  Targets targets;
};

Case random_case(Rng& rng) {
  Case c;
  c.limits.rate_max_deg_s = std::exp(rng.uniform(std::log(1.0), std::log(1000.0)));
  c.limits.acceleration_max_deg_s2 = std::exp(rng.uniform(std::log(1.0), std::log(1e5)));
  c.limits.view_deg = rng.uniform(20.0, 360.0);
  c.interval = Duration{static_cast<std::int64_t>(std::exp(rng.uniform(std::log(5e3), std::log(2e6))))};
  c.intervals = 4 + static_cast<int>(rng.uniform(0.0, 9.0));
  const double stoppable = c.intervals * c.interval.seconds() * c.limits.acceleration_max_deg_s2;
  c.start.yaw = rng.uniform(-3.0, 3.0);
  c.start.rate = to_radians(rng.uniform(-1.0, 1.0) * std::min(c.limits.rate_max_deg_s, stoppable));
  c.targets.resize(idx(c.intervals + 3));
  for (auto& list : c.targets) {
    for (int k = static_cast<int>(rng.uniform(0.0, 4.0)); k > 0; --k) {
      list.push_back({rng.uniform(-4.0, 4.0), rng.uniform(0.0, 5.0)});
    }
  }
  return c;
}

Case looking_at(double bearing, double worth = 3.0) {
  Case c;
  c.interval = Duration{250'000};
  c.targets.assign(idx(c.intervals + 3), {{bearing, worth}});
  return c;
}

std::optional<std::vector<double>> found(const Case& c) {
  return search_heading(heading_start(c.start, c.interval), c.interval, c.targets, c.limits);
}

PlanHeading heading_of(const Case& c, std::vector<double> points) {
  PlanHeading heading;
  heading.start = kZero;
  heading.interval = c.interval;
  heading.control_points = std::move(points);
  return heading;
}

double cost_of(const Case& c, const std::vector<double>& points) {
  double cost = 0.0;
  for (int i = 1; i <= c.intervals + 1; ++i) {
    const double span = rate_span(i, c.intervals, c.interval.seconds());
    const double w = (points[idx(i + 1)] - points[idx(i)]) / span;
    const double half_view = to_radians(0.5 * c.limits.view_deg);
    cost += span * (unseen_cost(points[idx(i + 1)], c.targets[idx(i + 1)], half_view) + kTurnCost * w * w);
  }
  return cost;
}

TEST(HeadingSearch, ASplineThatItFindsKeepsItsLimitsEverywhereJoinsItsStartAndEndsAtRateZero) {
  Rng rng(7);
  int finds = 0;
  for (int round = 0; round < 400; ++round) {
    const Case c = random_case(rng);
    const auto points = found(c);
    if (!points) continue;
    ++finds;
    ASSERT_EQ(points->size(), c.targets.size());
    const PlanHeading heading = heading_of(c, *points);
    const auto report = heading_breach(heading, c.limits, c.start);
    ASSERT_TRUE(report.ok()) << round << ": " << report.text;
    const HeadingSpline spline(heading);
    const double rate_max = to_radians(c.limits.rate_max_deg_s) * (1.0 + kLimitTolerance);
    const double acceleration_max = to_radians(c.limits.acceleration_max_deg_s2) * (1.0 + kLimitTolerance);
    const Duration step{std::max<std::int64_t>(1, c.interval.us / 50)};
    for (UTime t = kZero; t + step < spline.end(); t = t + step) {
      const YawSample a = spline.sample(t), b = spline.sample(t + step);
      const double h = step.seconds();
      ASSERT_LE(std::abs(a.rate), rate_max) << round;
      ASSERT_LE(std::abs(b.yaw - a.yaw), rate_max * h + 1e-9) << round;
      ASSERT_LE(std::abs(b.rate - a.rate), acceleration_max * h + 1e-9) << round;
    }
    EXPECT_EQ(spline.sample(spline.end() + Duration{1}).rate, 0.0);
  }
  EXPECT_GT(finds, 300) << "of 400 starts from which the turn can be stopped";
}

TEST(HeadingSearch, ReturnsTheSameBitsForTheSameArguments) {
  Rng rng(8);
  for (int round = 0; round < 50; ++round) {
    const Case c = random_case(rng);
    ASSERT_EQ(found(c), found(c));
  }
}

TEST(HeadingSearch, TurnsTheShorterWayToTheOnlyTargetAndHalts) {
  for (const double from : {0.0, 1.0, 3.0, -3.0}) {
    for (const double to : {0.2, -1.2, 1.3, -0.4}) {
      Case c = looking_at(from + to);
      c.start.yaw = from;
      const auto points = found(c);
      ASSERT_TRUE(points);
      EXPECT_NEAR(points->back(), from + to, 2.0 * std::numbers::pi / kYawCells) << from << " + " << to;
      for (std::size_t k = 1; k < points->size(); ++k) {
        EXPECT_GE(((*points)[k] - (*points)[k - 1]) * to, -0.06) << "it turns back, or the longer way round";
      }
    }
  }
}

// A plan of 1.2 s is too short to bring what lies behind into view. Each plan turns on where the one before began.
TEST(HeadingSearch, TurnsTowardsWhatItCannotBringIntoViewWithinOnePlan) {
  for (const double behind : {3.1, -3.1, 2.6}) {
    Case c = looking_at(behind, 80.0);
    c.interval = Duration{200'000};
    const Duration replan{50'000};
    const double edge = to_radians(0.5 * c.limits.view_deg);
    int plans = 0;
    while (std::abs(behind - c.start.yaw) > edge) {
      ASSERT_LT(++plans, 60) << "3 s, at " << c.start.yaw << " rad";
      const auto points = found(c);
      ASSERT_TRUE(points);
      c.start = HeadingSpline(heading_of(c, *points)).sample(kZero + replan);
    }
  }
}

TEST(HeadingSearch, StaysWhereItLooksIfNothingIsWorthATurn) {
  Case c = looking_at(0.0, 0.0);
  c.start.yaw = 1.25;
  EXPECT_EQ(*found(c), std::vector<double>(9, 1.25));
}

TEST(HeadingSearch, LooksFirstAtOneAndThenAtAnother) {
  Case c = looking_at(0.0);
  for (std::size_t k = 5; k < c.targets.size(); ++k) c.targets[k] = {{1.4, 3.0}};
  const auto points = found(c);
  ASSERT_TRUE(points);
  EXPECT_LT(std::abs((*points)[2]), 0.5);
  EXPECT_GT(points->back(), 1.0);
}

/// Every path through a grid of rates, without merging.
double least_cost(const Case& c, std::vector<double> points, double rate, double step, double half_change) {
  const int i = static_cast<int>(points.size()) - 1;
  if (i > c.intervals) {
    points.push_back(points.back());
    return std::abs(rate) <= half_change + 1e-9 ? cost_of(c, points) : std::numeric_limits<double>::infinity();
  }
  const double rate_max = to_radians(c.limits.rate_max_deg_s);
  const double change = (i == 1 ? 1.0 : 2.0) * half_change + 1e-9;
  double least = std::numeric_limits<double>::infinity();
  for (int level = -40; level <= 40; ++level) {
    const double w = level * step;
    if (std::abs(w) > rate_max + 1e-9 || std::abs(w - rate) > change) continue;
    std::vector<double> longer = points;
    longer.push_back(points.back() + w * rate_span(i, c.intervals, c.interval.seconds()));
    least = std::min(least, least_cost(c, std::move(longer), w, step, half_change));
  }
  return least;
}

TEST(HeadingSearch, IsNearlyAsCheapAsTheBestOfAllPathsThroughItsGrid) {
  Rng rng(9);
  double worst = 0.0, sum = 0.0;
  constexpr int kRounds = 30;
  for (int round = 0; round < kRounds; ++round) {
    Case c;
    c.intervals = 4;
    c.interval = Duration{250'000};
    c.start.yaw = rng.uniform(-3.0, 3.0);
    for (int k = 0; k < 7; ++k) c.targets.push_back({{rng.uniform(-3.0, 3.0), rng.uniform(0.5, 5.0)}});
    const double half_change = 0.125 * to_radians(c.limits.acceleration_max_deg_s2);
    const double step = half_change / std::ceil(half_change / (to_radians(c.limits.rate_max_deg_s) / kRateSteps));
    const double best = least_cost(c, {c.start.yaw, c.start.yaw}, 0.0, step, half_change);
    const double more = cost_of(c, *found(c)) / best - 1.0;
    ASSERT_GT(more, -0.05) << "the search interpolates the cost between cells";
    worst = std::max(worst, more);
    sum += more;
  }
  EXPECT_LT(worst, 0.15);
  EXPECT_LT(sum / kRounds, 0.03);
}

TEST(HeadingSearch, FindsNoneIfTheTurnCannotBeStoppedWithinThePlan) {
  Case c = looking_at(0.0);
  c.interval = Duration{20'000};
  c.start.rate = to_radians(119.0);
  EXPECT_FALSE(found(c));
  c.start.rate = to_radians(121.0);
  c.interval = Duration{250'000};
  EXPECT_FALSE(found(c)) << "faster than the limit";
}

}  // namespace
}  // namespace tern
