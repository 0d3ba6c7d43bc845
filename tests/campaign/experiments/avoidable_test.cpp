#include "campaign/experiments/avoidable.h"

#include <gtest/gtest.h>

namespace tern {
namespace {

World passing(const Vec3& from, const Vec3& velocity, const Vec3& half) {
  ObstacleSpec spec;
  spec.centre = from;
  spec.half_extents = half;
  spec.motion = LinearMotion{velocity, 0.0};
  World world;
  world.obstacles.push_back(WorldObstacle::make(0, spec).value());
  return world;
}

RestingVehicle vehicle(double v_max) {
  RestingVehicle v;
  v.limits.v_max = Vec3::Constant(v_max);
  v.flight_box = Box(Vec3::Constant(-50), Vec3::Constant(50));
  return v;
}

TEST(ClearMoves, FindAWayOutOfOneSlowBox) {
  const World world = passing(Vec3(8, 0, 0), Vec3(-1, 0, 0), Vec3::Constant(0.5));
  EXPECT_GT(clear_moves(vehicle(2.0), world, 1, {}, 100), 50);
}

TEST(ClearMoves, FindNoneWhereTheVehicleIsTooSlow) {
  const World world = passing(Vec3(20, 0, 0), Vec3(-10, 0, 0), Vec3::Constant(2.0));
  EXPECT_EQ(clear_moves(vehicle(0.5), world, 1, {}), 0);
}

TEST(ClearMoves, FindNoneInACage) {
  const World world = passing(Vec3(8, 0, 0), Vec3(-1, 0, 0), Vec3::Constant(0.5));
  RestingVehicle caged = vehicle(2.0);
  caged.flight_box = Box(Vec3::Constant(-0.3), Vec3::Constant(0.3));
  EXPECT_EQ(clear_moves(caged, world, 1, {}), 0);
}

}  // namespace
}  // namespace tern
