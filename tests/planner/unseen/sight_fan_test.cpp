#include "planner/unseen/sight_fan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/random.h"

namespace tern {
namespace {

/// A level view from the origin along the yaw.
SensorView view_along(double yaw, ViewKind kind, double half, int columns) {
  SensorView view;
  view.kind = kind;
  const Eigen::Quaterniond ahead(Eigen::AngleAxisd(yaw, Vec3::UnitZ()));
  Eigen::Matrix3d level;  // columns: right, down and forward of C in a vehicle that looks along x
  level << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  const Eigen::Quaterniond q = ahead * Eigen::Quaterniond(level);
  view.q_WC = {q.w(), q.x(), q.y(), q.z()};
  view.left = view.right = half;
  view.up = view.down = 0.4;
  view.range_m = 10.0;
  view.rows = 8;
  view.columns = columns;
  view.depths.assign(static_cast<std::size_t>(8 * columns), kFarDepth);
  return view;
}

TEST(LevelFan, ReachesAsFarAsThePictureInItsOwnDirections) {
  for (const double yaw : {0.0, 2.0, -3.0}) {
    const SightFan fan = level_fan(view_along(yaw, ViewKind::Pinhole, 0.7, 32));
    ASSERT_EQ(fan.reach.size(), 64U);
    const auto at = [&](double turn, double r) {
      return Eigen::Vector2d(r * std::cos(yaw + turn), r * std::sin(yaw + turn));
    };
    EXPECT_TRUE(fan.sees_empty(at(0.0, 9.0), 0.2));
    EXPECT_TRUE(fan.sees_empty(at(0.6, 5.0), 0.2));
    EXPECT_FALSE(fan.sees_empty(at(0.69, 5.0), 0.2)) << "half of it is beside the picture";
    EXPECT_FALSE(fan.sees_empty(at(0.0, 9.9), 0.2)) << "half of it is beyond the range";
    EXPECT_FALSE(fan.sees_empty(at(std::numbers::pi, 3.0), 0.2));
    EXPECT_FALSE(fan.sees_empty(at(0.0, 0.1), 0.2)) << "the sensor is inside";
  }
}

TEST(LevelFan, OfALidarSeesAllAround) {
  const SightFan fan = level_fan(view_along(1.0, ViewKind::Spherical, std::numbers::pi, 90));
  for (double turn = 0.0; turn < 6.3; turn += 0.05) {
    EXPECT_TRUE(fan.sees_empty({4.0 * std::cos(turn), 4.0 * std::sin(turn)}, 0.3)) << turn;
  }
}

/// The depth of each column by a slow rule: the distance to a wall at x = wall, seen from the origin along the yaw.
TEST(LevelFan, IsNeverDeeperThanThePictureInAnyDirection) {
  Rng rng(11);
  for (int round = 0; round < 200; ++round) {
    const double yaw = rng.uniform(-3.0, 3.0), half = rng.uniform(0.2, 1.2);
    SensorView view = view_along(yaw, ViewKind::Pinhole, half, 24);
    for (auto& cell : view.depths) cell = static_cast<std::int16_t>(rng.uniform(0.0, 1000.0));
    const SightFan fan = level_fan(view);
    for (int k = 0; k < 50; ++k) {
      const double turn = rng.uniform(-half, half);  // to the left
      const double depth_column = (std::tan(-turn) + std::tan(half)) / (2.0 * std::tan(half)) * 24.0;
      const int column = std::min(23, static_cast<int>(depth_column));
      const double depth = view.depths[static_cast<std::size_t>(4 * 24 + column)] * view.unit_m;
      const double r = rng.uniform(0.1, 9.9);
      const Eigen::Vector2d p(r * std::cos(yaw + turn), r * std::sin(yaw + turn));
      if (fan.sees_empty(p, 1e-6)) {
        ASSERT_LE(r * std::cos(turn), depth + 1e-6) << round;
      }
    }
  }
}

TEST(LevelFan, OfATiltedOrBlindViewSeesNothing) {
  SensorView view = view_along(0.0, ViewKind::Pinhole, 0.7, 8);
  const Eigen::Quaterniond q = Eigen::Quaterniond(Eigen::AngleAxisd(0.1, Vec3::UnitX())) *
                               Eigen::Quaterniond(view.q_WC[0], view.q_WC[1], view.q_WC[2], view.q_WC[3]);
  view.q_WC = {q.w(), q.x(), q.y(), q.z()};
  EXPECT_TRUE(level_fan(view).reach.empty());
  view = view_along(0.0, ViewKind::Pinhole, 0.7, 8);
  view.depths.assign(view.depths.size(), kBlindDepth);
  EXPECT_FALSE(level_fan(view).sees_empty({3.0, 0.0}, 0.1));
  view.rows = view.columns = 0;
  EXPECT_TRUE(level_fan(view).reach.empty());
}

}  // namespace
}  // namespace tern
