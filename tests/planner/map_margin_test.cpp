// Boxes of the map for a vehicle that estimates its own pose: they are grown by PoseError::margin().
#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/world/body.h"
#include "planner/kept_field.h"
#include "tests/support/effort.h"
#include "tests/support/plan_judge.h"
#include "tests/support/random_splines.h"
#include "tests/support/voxel_maps.h"

namespace tern {
namespace {

using namespace support;

constexpr UTime kStart{50'000'000};

PoseError error_of(double sigma, double yaw_sigma, const Vec3& position) {
  PoseError error;
  error.position = position;
  for (const std::size_t k : {0U, 7U, 14U}) error.pose_covariance[k] = sigma * sigma;
  error.pose_covariance[35] = yaw_sigma * yaw_sigma;
  return error;
}

/// The world with this error in its predictions.
PlanningWorld with_error(PlanningWorld world, const PoseError& error) {
  TrackSet set = world.predictions->set;
  set.pose_error = error;
  world.predictions = std::make_shared<const PredictionProducts>(std::move(set));
  return world;
}

PlannerConfig quick() {
  PlannerConfig config;
  config.search.max_expansions = 120;
  return config;
}

Plan answer(const HorizonRequest& request, const PlanningWorld& world) {
  Budget budget = Budget::unlimited();
  return plan(request, world, quick(), budget).plan;
}

/// The judge grows each box by the margin at its nearest point, which is the least that the planner may take.
TEST(MapMargin, EveryPlanKeepsItFromEveryBox) {
  int planned = 0, relaxed = 0;
  const auto draws = static_cast<std::uint64_t>(at_effort(600));
  for (std::uint64_t seed = 1; seed <= draws; ++seed) {
    Rng rng(seed);
    const TimedSpline committed = random_trajectory(rng, Vec3(0, 0, 1), kStart, Limits{}, 6);
    HorizonRequest request = request_at(kStart + Duration{random_integer(rng, 0, 1'500'000)}, committed);
    request.body = body_of(kBodyKinds[seed % 3]);
    const Vec3& p = request.start.p;
    VoxelMap map = free_map({32, 32, 16}, 0.25, Vec3(p - Vec3(4, 4, 2)));
    sprinkle(map, rng, 0.003, VoxelLabel::Occupied);
    map.version = map.compute_version();
    const PoseError error = error_of(rng.uniform(0.0, 0.15), rng.uniform(0.0, 0.03), p);
    const PlanningWorld world =
        with_error(world_of({}, go_to(p + random_vector(rng, 8.0)), request, quick(), map), error);
    const Plan got = answer(request, world);
    EXPECT_EQ(fault_of(got, request, world, quick()), "") << "seed " << seed;
    const bool is_new = got.outcome != PlanOutcome::NoPlan && got.outcome != PlanOutcome::KeepCommitted;
    planned += is_new ? 1 : 0;
    relaxed += is_new && got.relaxed ? 1 : 0;
  }
  EXPECT_GT(planned, 0.3 * static_cast<double>(draws));
  EXPECT_GT(relaxed, 0);
}

/// A wall across x = 4 m with a gap of 1 m at y = 0, the full height of the flight box.
VoxelMap gate() {
  VoxelMap map = free_map({40, 40, 16}, 0.25, Vec3(-1, -5, -1));
  paint(map, {20, 0, 0}, {20, 17, 15}, VoxelLabel::Occupied);
  paint(map, {20, 22, 0}, {20, 39, 15}, VoxelLabel::Occupied);
  map.version = map.compute_version();
  return map;
}

TEST(MapMargin, AVehicleFliesThroughAGateUnlessTheMarginClosesIt) {
  HorizonRequest request = request_at(kStart, resting_at(Vec3(3, 0, 1), kStart - Duration{1'000'000}));
  request.flight_box = Box(Vec3(-1, -5, 0), Vec3(9, 5, 2.5));
  const PlanningWorld open = world_of({}, go_to(Vec3(7, 0, 1)), request, quick(), gate());
  const auto makes_progress = [&](double sigma) {
    const Plan got = answer(request, with_error(open, error_of(sigma, 0.0, request.start.p)));
    EXPECT_NE(got.outcome, PlanOutcome::NoPlan);
    return got.trajectory.control_points.rightCols<1>().x() > 4.5;
  };
  EXPECT_TRUE(makes_progress(0.05));  // a margin of 0.2 m
  EXPECT_FALSE(makes_progress(0.2));  // 0.7 m
}

TEST(KeptField, LeadsAroundTheMapsMarginUnlessItClosesEveryWay) {
  const Vec3 start(0, 0, 1);
  const auto map = std::make_shared<const MapProducts>(gate(), PlannerConfig{});
  GoalFieldKey key{Vec3(7, 0, 1), map->version, 0, box_around(Vec3::Zero(), Vec3::Constant(0.1)),
                   Box(Vec3(-1, -5, 0), Vec3(9, 5, 2.5))};
  for (const double margin : {0.0, 0.3, 0.7}) {
    key.map_margin = margin;
    const KeptField kept = make_kept_field(key, map, PathObstacles{{}, {}, margin}, start);
    EXPECT_TRUE(kept.field->path_from(start)) << margin;
    EXPECT_EQ(kept.is_blocked, margin == 0.7);
    EXPECT_TRUE(serves(kept, key, {})) << "it is not made again";
    GoalFieldKey narrower = key;
    narrower.body = box_around(Vec3::Zero(), Vec3::Constant(0.05));
    EXPECT_EQ(serves(kept, narrower, {}), margin == 0.3) << "on an estimate the tube changes often";
    EXPECT_EQ(make_goal_field(key, map, {}, start).path_from(start).has_value(), margin < 0.7);
  }
}

}  // namespace
}  // namespace tern
