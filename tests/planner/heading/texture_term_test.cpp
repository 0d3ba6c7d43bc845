#include "planner/heading/texture_term.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/heading/heading_planner.h"
#include "tests/support/planner_worlds.h"

namespace tern {
namespace {

using namespace support;

constexpr UTime kZero{1'700'000'000'000'000};

/// A dark hall with one textured wall along y = −6.
const InformationMap& hall() {
  static const InformationMap map = [] {
    VoxelMap voxels;
    voxels.grid = {Vec3(0, -7, 0), 0.5, {60, 2, 8}};
    voxels.labels.assign(static_cast<std::size_t>(voxels.grid.voxels()), VoxelLabel::Attractive);
    voxels.classes.assign(voxels.labels.size(), 1);
    voxels.class_names = {"", "texture"};
    LandmarkPriors dark;
    dark.ground = 0.03;
    return InformationMap(SurfaceMap(voxels, dark), Box(Vec3(0, -3, 0), Vec3(30, 3, 4)), {1.0});
  }();
  return map;
}

std::vector<LookTarget> targets_at(const Vec3& p) {
  std::vector<LookTarget> targets;
  TextureTerm(hall(), 20.0).look({kZero, p, Vec3(5, 0, 0)}, targets);
  return targets;
}

TEST(TextureTerm, IsCheapestWhereTheViewShowsTheWall) {
  const std::vector<LookTarget> targets = targets_at({15, 0, 1});
  double best = 0.0, least = 1e9;
  for (int deg = -180; deg < 180; deg += 5) {
    const double yaw = deg * std::numbers::pi / 180.0, cost = unseen_cost(yaw, targets, 0.01);
    if (cost < least) least = cost, best = yaw;
  }
  EXPECT_NEAR(best, -std::numbers::pi / 2, 0.5);
  EXPECT_GT(unseen_cost(std::numbers::pi / 2, targets, 0.01), 2.0 * least) << "the view has its own width";
}

TEST(TextureTerm, WeighsAtMostTheErrorOfSomeSecondsInTheDark) {
  for (const double x : {0.0, 15.0, 30.0}) {
    double sum = 0.0;
    for (const LookTarget& target : targets_at({x, 0, 1})) sum += target.worth;
    EXPECT_GT(sum, 0.0);
    EXPECT_LT(sum, 0.2) << "m of σ per second";
  }
}

/// Straight along x at 4 m/s in the hall.
TimedSpline straight() {
  const double x[] = {0.0, 0.4, 1.2, 2.4, 3.6, 4.8, 5.2, 5.2, 5.2};
  Points points = Points::Constant(3, 9, 1.0);
  for (int k = 0; k < 9; ++k) points.col(k) = Vec3(x[k], 0.0, 1.0);
  return {kZero, Duration{300'000}, points};
}

double yaw_at_end(double view_deg, const LookTerm* texture) {
  Plan plan;
  plan.outcome = PlanOutcome::Optimized;
  plan.trajectory = straight();
  plan.trajectory.control_points.row(0).array() += 10.0;
  plan.local_goal = Vec3(16, 0, 1);
  const HorizonRequest request = request_at(kZero, plan.trajectory);
  HeadingLimits limits;
  limits.view_deg = view_deg;
  const auto heading = plan_heading(request, plan, {}, limits, heading_start({0.0, 0.0}, plan.trajectory.interval),
                                    {.texture = texture});
  return heading->control_points.back();
}

TEST(PlanHeading, TurnsToTextureIfObstaclesAreSeenAllRound) {
  const TextureTerm texture(hall(), 20.0);
  EXPECT_LT(yaw_at_end(360.0, &texture), -0.6) << "towards the wall to the right";
  EXPECT_NEAR(yaw_at_end(85.0, &texture), 0.0, 0.2) << "the way comes first for a camera of obstacles";
  EXPECT_NEAR(yaw_at_end(360.0, nullptr), 0.0, 1e-6);
}

}  // namespace
}  // namespace tern
