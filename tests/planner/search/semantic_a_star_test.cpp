#include "planner/search/semantic_a_star.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/world/flyable.h"
#include "planner/duration.h"
#include "planner/safety/checker.h"
#include "tests/support/flat_outputs.h"
#include "tests/support/planner_worlds.h"
#include "tests/support/random_splines.h"

namespace tern {
namespace {

using namespace support;

constexpr UTime kStart{50'000'000};
constexpr double kRadius = 4.0;
constexpr double kHold = 1.5;
const Box kOpen(Vec3::Constant(-1e4), Vec3::Constant(1e4));

/// A search and the conditions that its leaf must satisfy.
struct Scene {
  std::vector<Track> tracks;
  std::vector<PlanningObstacle> obstacles;
  Body body;
  SearchProblem problem;

  [[nodiscard]] SweptObstacles sweep() const {
    std::vector<double> times;
    for (int k = 0; k <= problem.intervals; ++k) times.push_back(k * problem.interval_s());
    const double end = times.back();
    for (double hold = 0.1; hold < kHold + 1e-9; hold += 0.1) times.push_back(end + hold);
    return {obstacles, body, kStart, std::move(times), box_around(problem.start.p, Vec3::Constant(kRadius))};
  }
  [[nodiscard]] SearchResult search(const SearchConfig& config = {}) const {
    const SweptObstacles swept = sweep();
    SeparationCache cache(swept);
    Budget budget = Budget::unlimited();
    SearchMemory memory;
    return semantic_a_star(problem, config, cache, budget, memory);
  }
  [[nodiscard]] CheckReport check(const SearchResult& result) const {
    const SweptObstacles swept = sweep();
    SeparationCache cache(swept);
    return check_plan({kStart, problem.interval, result.control_points}, problem, cache);
  }
};

Scene scene_from(const MotionSample& start, double interval_s, const Vec3& goal, std::vector<Track> tracks = {}) {
  Scene s;
  s.tracks = std::move(tracks);
  s.obstacles = obstacles_of(s.tracks);
  s.problem.start = start;
  s.problem.interval = Duration::from_seconds(interval_s);
  s.problem.plan_limits.v_max *= 0.99;
  s.problem.sphere_radius = kRadius;
  s.problem.centre_box = kOpen;
  s.problem.cost_to_go.point = goal;
  return s;
}

/// Up to 12 movers around a vehicle that is under way; limits, body, flight box and jerk limit vary.
Scene random_scene(std::uint64_t seed) {
  Rng rng(seed);
  Limits limits;
  if (rng.uniform() < 0.3) limits.j_max = Vec3::Constant(rng.uniform(60.0, 200.0));
  const TimedSpline flown = random_trajectory(rng, random_vector(rng, 1.0), kStart, limits);
  MotionSample start =
      rng.uniform() < 0.3 ? MotionSample{} : flown.sample(kStart + Duration{random_integer(rng, 0, 1'000'000)});
  std::vector<Track> tracks;
  for (int id = random_integer(rng, 0, 12); id > 0; --id) {
    tracks.push_back(random_mover(rng, id, box_around(start.p, Vec3::Constant(4.0)), kStart - Duration{200'000}, 4.0));
  }
  Scene s = scene_from(start, 1e-6 * random_integer(rng, 100'000, 350'000), Vec3(start.p + random_vector(rng, 6.0)),
                       std::move(tracks));
  s.body = body_of(kBodyKinds[random_integer(rng, 0, 2)]);
  s.problem.intervals = random_integer(rng, 4, 8);
  s.problem.limits = s.problem.plan_limits = limits;
  s.problem.plan_limits.v_max *= 0.99;
  s.problem.cost_to_go.rest = rng.uniform(0.0, 3.0);
  if (rng.uniform() < 0.5) {
    const Vec3 half(rng.uniform(0.5, 5.0), rng.uniform(0.5, 5.0), rng.uniform(0.5, 5.0));
    s.problem.centre_box = centre_box(box_around(start.p, half), s.body);
  }
  return s;
}

SearchConfig quick() {
  SearchConfig config;
  config.max_expansions = 200;
  return config;
}

TEST(SemanticAStar, NeverReturnsALeafThatTheCheckerRejects) {
  int found = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    const Scene s = random_scene(seed);
    const SearchResult result = s.search(quick());
    if (!result.found) continue;
    ++found;
    ASSERT_EQ(result.control_points.cols(), s.problem.intervals + 3);
    const CheckReport report = s.check(result);
    ASSERT_TRUE(report.ok()) << "seed " << seed << ": " << report.text() << " in interval " << report.interval;
  }
  EXPECT_GT(found, 150);
}

TEST(SemanticAStar, OfAMultirotorItsLeavesAreFlyable) {
  int found = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    Rng rng(seed);
    Scene s = random_scene(seed);
    s.problem.start.a = Vec3::Zero();
    s.problem.limits.dynamics = s.problem.plan_limits.dynamics = random_dynamics(rng);
    const SearchResult result = s.search(quick());
    if (!result.found) continue;
    ++found;
    const CheckReport report = s.check(result);
    ASSERT_TRUE(report.ok()) << "seed " << seed << ": " << report.text() << " in interval " << report.interval;
    const ClampedSpline flown(result.control_points, s.problem.interval_s());
    ASSERT_TRUE(flat_outputs(flown).within(*s.problem.limits.dynamics, 1e-5)) << "seed " << seed;
  }
  EXPECT_GT(found, 60);
}

TEST(SemanticAStar, WhatItSaysOfItsLeafIsTrue) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const Scene s = random_scene(seed);
    const SearchResult result = s.search(quick());
    if (!result.found) continue;
    const Vec3 end = result.control_points.rightCols<1>();
    EXPECT_EQ(result.cost_to_go, s.problem.cost_to_go.from(end));
    const SweptObstacles swept = s.sweep();
    SeparationCache cache(swept);
    PairCounts counts;
    EXPECT_EQ(result.hold_s, clear_time_at(cache, s.problem.intervals, end, counts).seconds);
  }
}

TEST(SemanticAStar, GivesTheSameBitsTwiceAndInWhateverOrderTheObstaclesCome) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Scene s = random_scene(seed);
    const SearchResult first = s.search(quick());
    const SearchResult second = s.search(quick());
    ASSERT_EQ(first.found, second.found);
    ASSERT_EQ(first.control_points, second.control_points);
    ASSERT_EQ(first.expansions, second.expansions);
    std::reverse(s.obstacles.begin(), s.obstacles.end());
    const SearchResult reversed = s.search(quick());
    ASSERT_EQ(first.found, reversed.found);
    ASSERT_EQ(first.control_points, reversed.control_points) << "seed " << seed;
  }
}

TEST(SemanticAStar, ABudgetCutReplaysToTheSameBits) {
  int cut_and_found = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const Scene s = random_scene(seed);
    for (const std::int64_t n : {0, 3, 17, 90}) {
      Budget live([n](const BudgetCut& here) { return here.stage == Stage::Search && here.count >= n; });
      const SweptObstacles swept = s.sweep();
      SeparationCache cache(swept), again(swept);
      SearchMemory memory;
      const SearchResult first = semantic_a_star(s.problem, SearchConfig{}, cache, live, memory);
      ASSERT_LE(live.cuts().size(), 1u);
      Budget replay = Budget::replay(live.cuts());
      const SearchResult second = semantic_a_star(s.problem, SearchConfig{}, again, replay, memory);
      ASSERT_EQ(first.found, second.found);
      ASSERT_EQ(first.control_points, second.control_points) << "seed " << seed << ", cut at " << n;
      ASSERT_EQ(first.expansions, second.expansions);
      if (first.found && !live.cuts().empty()) ++cut_and_found;
    }
  }
  EXPECT_GT(cut_and_found, 3);
}

TEST(SemanticAStar, ShowsItsTreeWithoutAnotherAnswer) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Scene s = random_scene(seed);
    const SearchResult silent = s.search();
    s.problem.keep_nodes = true;
    const SearchResult shown = s.search();
    EXPECT_TRUE(silent.nodes.empty());
    ASSERT_EQ(shown.found, silent.found);
    ASSERT_EQ(shown.control_points, silent.control_points) << "seed " << seed;
    ASSERT_GE(static_cast<std::int64_t>(shown.nodes.size()), shown.expansions);
    for (std::size_t k = 0; k < shown.nodes.size(); ++k) {
      ASSERT_LT(shown.nodes[k].parent, static_cast<std::int32_t>(k));
      ASSERT_EQ(shown.nodes[k].parent < 0, k == 0);
    }
    if (!shown.found) continue;
    const Vec3 leaf = shown.control_points.rightCols<1>();
    const auto is_leaf = [&](const SearchViewNode& node) { return node.position == leaf; };
    EXPECT_TRUE(std::any_of(shown.nodes.begin(), shown.nodes.end(), is_leaf)) << "seed " << seed;
  }
}

TEST(SemanticAStar, InAnEmptyWorldItComesAsNearAsAMuchFinerSearch) {
  SearchConfig fine;
  fine.samples_xy = fine.samples_z = 9;
  fine.max_expansions = 20'000;
  for (std::uint64_t seed = 1; seed <= 25; ++seed) {
    Rng rng(seed);
    const Vec3 goal = random_vector(rng, 2.2);
    const double duration = rng.uniform(1.1, 1.8) * min_duration({}, goal, Limits{});
    const Scene s = scene_from({}, std::max(duration / 6, 0.05), goal);
    const SearchResult usual = s.search();
    const SearchResult finer = s.search(fine);
    ASSERT_TRUE(usual.found && finer.found) << "seed " << seed;
    EXPECT_LE(usual.cost_to_go, finer.cost_to_go + SearchConfig{}.band_m) << "seed " << seed;
  }
}

TEST(SemanticAStar, AmongAFewBoxesItComesAsNearAsAMuchFinerSearch) {
  SearchConfig fine;
  fine.samples_xy = 7;
  fine.samples_z = 5;
  fine.max_expansions = 8'000;
  for (std::uint64_t seed = 1; seed <= 15; ++seed) {
    Rng rng(seed);
    std::vector<Track> tracks;
    for (int id = 1; id <= 3; ++id) {
      const Vec3 at(rng.uniform(0.9, 2.5), rng.uniform(-1.0, 1.0), rng.uniform(-0.6, 0.6));
      tracks.push_back(standing_box(id, box_around(at, Vec3(0.2, 0.3, 0.3)), kStart));
    }
    const Scene s = scene_from({}, 0.25, Vec3(3.5, 0, 0), std::move(tracks));
    const SearchResult usual = s.search();
    const SearchResult finer = s.search(fine);
    ASSERT_TRUE(usual.found && finer.found) << "seed " << seed;
    EXPECT_LE(usual.cost_to_go, finer.cost_to_go + SearchConfig{}.band_m) << "seed " << seed;
  }
}

TEST(SemanticAStar, EndsWhenNothingOpenCanStillWinNotWhenItsBudgetEnds) {
  const Scene s = scene_from({}, 0.25, Vec3(2.5, 0.5, 0.2));
  const SearchResult result = s.search();
  ASSERT_TRUE(result.found);
  EXPECT_LT(result.expansions, SearchConfig{}.max_expansions / 10);
}

/// Bands that are counted from 0 leave a sliver of a band within S. Every node seems to reach it and no leaf does, so
/// at some distances all expansions would go there.
TEST(SemanticAStar, OfAMultirotorNoDistanceOfTheGoalMakesItSearchInVain) {
  MotionSample start;
  start.v = Vec3(4.7, -0.1, 0.0);
  for (const double interval_s : {0.2, 0.22, 0.27, 0.31, 0.36}) {
    for (int mm = 14'000; mm < 15'000; mm += 2) {
      Scene s = scene_from(start, interval_s, Vec3(0.001 * mm, 0, 0));
      s.problem.plan_limits.a_max = s.problem.limits.a_max = Vec3(20.0, 20.0, 10.0);
      s.problem.limits.dynamics = s.problem.plan_limits.dynamics = Dynamics{2.0, 39.2, 70.0, 900.0};
      const SearchResult result = s.search();
      ASSERT_TRUE(result.found) << interval_s << " s, " << mm << " mm";
      ASSERT_LT(result.expansions, SearchConfig{}.max_expansions / 20) << interval_s << " s, " << mm << " mm";
      ASSERT_GT(s.problem.cost_to_go.from(start.p) - result.cost_to_go, 0.95 * kRadius)
          << interval_s << " s, " << mm << " mm";
    }
  }
}

TEST(SemanticAStar, StartsAtNearlyTheTopSpeedWithOutwardAccelerationAreSolvable) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      for (const double outward : {1.0, 2.5}) {
        MotionSample start;
        start.v[axis] = sign * 0.98 * Limits{}.v_max[axis];
        start.a[axis] = sign * outward;
        start.v[(axis + 1) % 3] = 2.0;
        const Scene s = scene_from(start, axis == 2 ? 0.18 : 0.12, 3.5 * start.v.normalized());
        const SearchResult result = s.search();
        ASSERT_TRUE(result.found) << "axis " << axis << ", sign " << sign << ", " << outward << " m/s^2";
        EXPECT_TRUE(s.check(result).ok());
      }
    }
  }
}

TEST(SemanticAStar, AnEndThatStaysClearIsPreferredToANearerOneThatDoesNot) {
  // A mover crosses the goal shortly after the vehicle would arrive.
  const double interval = 0.45;
  const double crossing_s = 4 * interval + 0.3;
  const Vec3 goal(2, 0, 0);
  const std::vector<Track> tracks{
      straight_mover(1, goal - Vec3(0, 3.0 * crossing_s, 0), Vec3(0, 3, 0), 0.4, kStart, 5.0)};
  Scene s = scene_from({}, interval, goal, tracks);
  s.problem.intervals = 4;
  s.problem.hold_required_s = 0.0;
  const SearchResult careless = s.search();
  ASSERT_TRUE(careless.found);
  EXPECT_LT(careless.cost_to_go, 0.5);
  EXPECT_LT(careless.hold_s, 0.5);
  s.problem.hold_required_s = 1.0;
  const SearchResult careful = s.search();
  ASSERT_TRUE(careful.found);
  EXPECT_GE(careful.hold_s, 1.0);
  EXPECT_LT(careful.cost_to_go, 1.5);
}

TEST(SemanticAStar, AWalledInStartHasNoLeafBeyondTheWalls) {
  std::vector<Track> tracks;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      Vec3 half = Vec3::Constant(2.0);
      half[axis] = 0.1;
      tracks.push_back(standing_box(static_cast<std::int64_t>(tracks.size()) + 1,
                                    box_around(Vec3::Unit(axis) * side, half), kStart));
    }
  }
  const Scene s = scene_from({}, 0.25, Vec3(3, 0, 0), tracks);
  const SearchResult result = s.search(quick());
  if (result.found) {
    EXPECT_LT(result.control_points.cwiseAbs().maxCoeff(), 0.8);
  }
}

TEST(SemanticAStar, AStepsCostBendsTheWayAroundWhatIsDear) {
  // An expensive slab lies across the straight line; only y > 0.5 is free of it.
  const Vec3 goal(3, 0, 0);
  Scene s = scene_from({}, 0.3, goal);
  const auto dear_metres = [](const Vec3& a, const Vec3& b) {
    double sum = 0.0;
    for (int k = 0; k < 8; ++k) {
      const Vec3 p = a + (b - a) * ((k + 0.5) / 8);
      if (p.x() > 1.0 && p.x() < 2.0 && p.y() < 0.5) sum += (b - a).norm() / 8;
    }
    return sum;
  };
  const auto dear_of = [&](const SearchResult& r) {
    double sum = 0.0;
    for (Eigen::Index l = 1; l < r.control_points.cols(); ++l)
      sum += dear_metres(r.control_points.col(l - 1), r.control_points.col(l));
    return sum;
  };
  const SearchResult blind = s.search();
  s.problem.accumulated = [&](const Vec3& a, const Vec3& b) { return 5.0 * dear_metres(a, b); };
  const SearchResult seeing = s.search();
  ASSERT_TRUE(blind.found && seeing.found);
  EXPECT_GT(dear_of(blind), 0.8);
  EXPECT_LT(dear_of(seeing), 0.5 * dear_of(blind));
  EXPECT_LT(seeing.cost_to_go, 1.0);
}

}  // namespace
}  // namespace tern
