// Ways that are chosen by the price of the position's error (planner.semantics.error_price).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <vector>

#include "core/base/random.h"
#include "planner/kept_field.h"
#include "planner/planning_world.h"
#include "planner/semantics/error_price.h"
#include "tests/support/effort.h"
#include "tests/support/path_length.h"

namespace tern {
namespace {

constexpr double kSpeed = 5.4;

/// A map of 70 × 40 × 4 m whose voxels of 0.5 m in these boxes are water.
VoxelMap water(const std::vector<Box>& boxes) {
  VoxelMap map;
  map.grid.origin = Vec3(0, -20, 0);
  map.grid.resolution = 0.5;
  map.grid.size = {140, 80, 8};
  map.labels.assign(static_cast<std::size_t>(map.grid.voxels()), VoxelLabel::Free);
  map.classes.assign(map.labels.size(), 0);
  map.class_names = {"", "water"};
  map.version = 1;
  for (std::int64_t i = 0; i < map.grid.voxels(); ++i) {
    const Vec3 at = map.grid.centre(map.grid.cell(i));
    if (std::none_of(boxes.begin(), boxes.end(), [&](const Box& box) { return box.contains(at); })) continue;
    map.labels[static_cast<std::size_t>(i)] = VoxelLabel::Repulsive;
    map.classes[static_cast<std::size_t>(i)] = 1;
  }
  return map;
}

/// From (−5, 0, 1) to (75, 0, 1). The flight box keeps the vehicle low, so that a way is aside or across.
struct PricedWorld {
  std::shared_ptr<const MapProducts> map;
  GoalFieldKey key;
  Vec3 start{-5, 0, 1};

  PricedWorld(const std::vector<Box>& lakes, double price, const std::vector<Box>& obstacles = {}) {
    PlannerConfig config;
    config.error_price.error_price = price;
    map = std::make_shared<const MapProducts>(water(lakes), config);
    key = {Vec3(75, 0, 1),
           1,
           0,
           box_around(Vec3::Zero(), Vec3::Constant(0.1)),
           Box(Vec3(-10, -25, 0.6), Vec3(80, 25, 1.4)),
           price > 0.0 ? kSpeed : 0.0};
    field = make_goal_field(key, map, obstacles, start);
    path = field.path_from(start).value();
  }
  GoalField field;
  std::vector<Vec3> path;
};

double aside(const std::vector<Vec3>& path) {
  double most = 0.0;
  for (const Vec3& p : path) most = std::max(most, std::abs(p.y()));
  return most;
}

const Box kLake(Vec3(12, -6, 0), Vec3(57, 6, 4));

const PricedWorld& lake_at_20() {
  static const PricedWorld world({kLake}, 20.0);
  return world;
}

TEST(PricedWay, WithoutAPriceIsThatOfTheLambdas) {
  PlannerConfig config;
  const auto map = std::make_shared<const MapProducts>(water({kLake}), config);
  EXPECT_TRUE(map->semantic_paths);
  EXPECT_EQ(way_speed(*map, Limits{}), 0.0);
  EXPECT_FALSE(PricedWorld({kLake}, 0.0).field.cost().priced);
}

TEST(PricedWay, LeavesALakeFartherAsideTheMoreAnErrorCosts) {
  const double cheap = aside(PricedWorld({kLake}, 0.1).path), dear = aside(lake_at_20().path);
  EXPECT_LT(cheap, 1.0) << "0.4 m of error are not worth the detour";
  EXPECT_GT(dear, 4.0);
  EXPECT_LE(path_length(lake_at_20().path), 1.10 * 80.0);
}

TEST(PricedWay, CrossesAPondThatIsDarkForAMoment) {
  EXPECT_LT(aside(PricedWorld({Box(Vec3(30, -15, 0), Vec3(34, 15, 4))}, 20.0).path), 2.0);
}

TEST(PricedWay, StaysClearOfObstacles) {
  const Box rock(Vec3(20, 4, 0), Vec3(30, 12, 4));
  const PricedWorld world({kLake}, 20.0, {rock});
  for (std::size_t k = 1; k < world.path.size(); ++k) {
    EXPECT_FALSE(segment_meets_box(world.path[k - 1], world.path[k], grown(rock, Vec3::Constant(0.1))));
  }
}

TEST(PricedWay, ForetellsMoreErrorAcrossALakeThanAroundIt) {
  const PricedWorld& world = lake_at_20();
  const auto around = foretell_error(world.field, world.start, kSpeed);
  ASSERT_TRUE(around);
  const ForetoldError across = foretell_error({world.start, world.key.goal}, kSpeed, *world.field.cost().information);
  EXPECT_GT(across.at_goal, 1.5 * around->at_goal);
  EXPECT_GT(across.at_worst, 1.7 * around->at_worst);
}

/// A key that asks for a cube about the vehicle with this half side, with space above and below.
GoalFieldKey with_body(double half) {
  GoalFieldKey key = lake_at_20().key;
  key.flight_box = Box(Vec3(-10, -25, -1), Vec3(80, 25, 3));
  key.body = box_around(Vec3::Zero(), Vec3::Constant(half));
  return key;
}

KeptField kept_for(double half, const std::vector<Box>& obstacles = {}) {
  KeptField kept = make_kept_field(with_body(half), lake_at_20().map, obstacles, lake_at_20().start);
  EXPECT_TRUE(kept.field->path_from(lake_at_20().start));
  return kept;
}

TEST(KeptField, LeadsAroundRestingTracksUnlessTheyCloseEveryWay) {
  const PricedWorld& world = lake_at_20();
  const Box wall(Vec3(10, -100, -10), Vec3(11, 100, 10)), board(Vec3(10, -5, -10), Vec3(11, 5, 10));
  const auto path = [&](const PathObstacles& obstacles) {
    return make_kept_field(with_body(0.2), world.map, obstacles, world.start).field->path_from(world.start);
  };
  EXPECT_FALSE(path({{wall}, {}}));
  EXPECT_TRUE(path({{}, {wall}})) << "it may move";
  const auto around = path({{}, {board}});
  ASSERT_TRUE(around);
  for (std::size_t k = 1; k < around->size(); ++k)
    EXPECT_FALSE(segment_meets_box((*around)[k - 1], (*around)[k], board));
}

TEST(PricedWay, FieldServesWhileTheTubeChanges) {
  const KeptField kept = kept_for(0.23);
  EXPECT_NEAR(kept.key.body.max().x(), 0.3, 1e-9);
  for (const double half : {0.01, 0.1, 0.2, 0.23, 0.299}) EXPECT_TRUE(serves(kept, with_body(half), {})) << half;
  EXPECT_FALSE(serves(kept, with_body(0.31), {}));
  EXPECT_FALSE(serves(kept_for(0.53), with_body(0.1), {})) << "0.6 m would close passages for nothing";
  GoalFieldKey elsewhere = with_body(0.23);
  elsewhere.goal.y() += 1.0;
  EXPECT_FALSE(serves(kept, elsewhere, {}));
}

TEST(PricedWay, FieldServesWhileTheBoundsOfObstaclesChange) {
  const Box rock(Vec3(20.05, 4.05, 0.05), Vec3(29.95, 11.95, 3.95));
  const KeptField kept = kept_for(0.23, {rock});
  GoalFieldKey key = with_body(0.23);
  key.statics = 7;  // another digest
  const auto widened = [&](double by) { return std::vector<Box>{grown(rock, Vec3::Constant(by))}; };
  for (const double by : {-0.2, 0.0, 0.049}) EXPECT_TRUE(serves(kept, key, widened(by))) << by;
  EXPECT_FALSE(serves(kept, key, widened(0.06)));
  EXPECT_FALSE(serves(kept, key, widened(-0.3)));
  EXPECT_FALSE(serves(kept, key, {})) << "the rock is gone";
  EXPECT_FALSE(serves(kept, key, {rock, rock})) << "there is one more";
}

TEST(PricedWay, FieldServesSidesAtMultiplesOfItsStep) {
  // Sums such as 0.1 + 0.2 and 10 + 0.3 differ from multiples of 0.1 by rounding.
  std::vector<Box> pillars;
  for (double x = 10.0; x < 70.0; x += 8.1) pillars.push_back(box_around(Vec3(x, 3.0, 1.0), Vec3(0.3, 0.3, 2.1)));
  const KeptField kept = kept_for(0.1 + 0.2, pillars);
  GoalFieldKey other = with_body(0.1 + 0.2);
  other.statics = 7;
  EXPECT_TRUE(serves(kept, other, pillars));
}

TEST(PricedWay, WithoutAPriceAFieldServesItsOwnInputsAlone) {
  KeptField kept{nullptr, with_body(0.2), {}, false};
  kept.key.speed = 0.0;
  GoalFieldKey smaller = kept.key;
  smaller.body = box_around(Vec3::Zero(), Vec3::Constant(0.19));
  EXPECT_TRUE(serves(kept, kept.key, {}));
  EXPECT_FALSE(serves(kept, smaller, {}));
}

TEST(PricedWay, GoesThroughAPassageThatTheRoundedBodyWouldClose) {
  // A gap of 0.52 m in a wall: the vehicle needs 0.44 m, and 0.6 m if its sides are rounded up.
  const std::vector<Box> wall{Box(Vec3(20, -30, -2), Vec3(21, -0.26, 5)), Box(Vec3(20, 0.26, -2), Vec3(21, 30, 5))};
  const KeptField kept = kept_for(0.22, wall);
  EXPECT_TRUE(kept.key == with_body(0.22));
  EXPECT_FALSE(serves(kept, with_body(0.23), wall));
}

TEST(PricedWay, ABlockedFieldServesNoSmallerBody) {
  const std::vector<Box> wall{Box(Vec3(20, -30, -2), Vec3(21, -0.26, 5)), Box(Vec3(20, 0.26, -2), Vec3(21, 30, 5))};
  const PricedWorld& world = lake_at_20();
  const KeptField kept = make_kept_field(with_body(0.3), world.map, wall, world.start);
  ASSERT_FALSE(kept.field->path_from(world.start));
  EXPECT_FALSE(serves(kept, with_body(0.22), wall)) << "it fits the gap";
  EXPECT_TRUE(serves(kept, kept.key, wall)) << "the same field is not made again";
}

/// The least J of all ways with two corners: brute force.
double least_cost(const PricedWorld& world, const ErrorPrice& price) {
  double least = priced_cost({world.start, world.key.goal}, price);
  for (double y = -22.0; y <= 22.0; y += 1.0) {
    for (double from = 0.0; from <= 30.0; from += 3.0) {
      for (double to = 33.0; to <= 70.0; to += 3.0) {
        least = std::min(least, priced_cost({world.start, Vec3(from, y, 1), Vec3(to, y, 1), world.key.goal}, price));
      }
    }
  }
  return least;
}

TEST(PricedWay, CostsAtMostOnePercentMoreThanAnyWayWithTwoCorners) {
  Rng rng(36);
  for (int k = 0; k < support::at_effort(30); ++k) {
    std::vector<Box> lakes;
    for (int n = 0; n < 1 + k % 2; ++n) {
      const Vec3 centre(rng.uniform(15.0, 50.0), rng.uniform(-6.0, 6.0), 2.0);
      lakes.push_back(box_around(centre, Vec3(rng.uniform(4.0, 25.0), rng.uniform(3.0, 9.0), 2.0)));
    }
    const double value = 5.0 * (1 << (k % 4));
    const PricedWorld world(lakes, value);
    const ErrorPrice price(world.field.cost().information, value, kSpeed);
    const double ratio = priced_cost(world.path, price) / least_cost(world, price);
    std::printf("world %d, price %.0f: %.4f of the least cost, %.1f m aside\n", k, value, ratio, aside(world.path));
    EXPECT_LE(ratio, 1.01);
  }
}

}  // namespace
}  // namespace tern
