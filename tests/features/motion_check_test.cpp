// The motion that most points agree with.
#include "features/motion_check.h"

#include <gtest/gtest.h>

#include "core/base/random.h"

namespace tern {
namespace {

constexpr double kSigma = 1.0 / 460.0, kBaseline = 0.11;

struct Scene {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  Vec3 t = Vec3::Zero();
  double noise = 0.2 * kSigma;
};

/// Points in front of the camera before and after its motion. The last `moving` of them also move by `by` themselves.
std::vector<MovedPoint> points_of(const Scene& scene, int count, int moving, const Vec3& by, Rng& random) {
  std::vector<MovedPoint> points;
  for (int k = 0; k < count; ++k) {
    const double z = random.uniform(2.0, 10.0);
    const Vec3 x(random.uniform(-0.7, 0.7) * z, random.uniform(-0.5, 0.5) * z, z);
    const Vec3 now = scene.R * (k < count - moving ? x : Vec3(x + by)) + scene.t;
    MovedPoint point;
    point.now =
        Eigen::Vector2d(now.head<2>() / now.z()) + scene.noise * Eigen::Vector2d(random.normal(), random.normal());
    const double disparity = kBaseline / z + scene.noise * random.normal();
    point.before = x * (kBaseline / disparity / z);
    point.has_depth = true;
    points.push_back(point);
  }
  return points;
}

Scene flight() {
  return {Eigen::AngleAxisd(0.05, Vec3(0.3, 1.0, 0.2).normalized()).toRotationMatrix(), Vec3(0.05, -0.02, -0.25)};
}

TEST(MotionCheck, KeepsWhatRestsAndEndsWhatMoves) {
  Rng random(3);
  for (int round = 0; round < 50; ++round) {
    const auto points = points_of(flight(), 100, 35, Vec3(0.4, 0.0, 0.0), random);
    const auto agrees = agree_with_motion(points, kSigma, kBaseline);
    ASSERT_TRUE(agrees);
    int wrong_rest = 0, wrong_moving = 0;
    for (int k = 0; k < 100; ++k) {
      wrong_rest += k < 65 && !(*agrees)[idx(k)] ? 1 : 0;
      wrong_moving += k >= 65 && (*agrees)[idx(k)] ? 1 : 0;
    }
    EXPECT_LE(wrong_rest, 3);
    EXPECT_LE(wrong_moving, 3) << "one that moves along its own ray is not seen to move";
  }
}

TEST(MotionCheck, HoldsWhenTheCameraOnlyTurnsOrRests) {
  Rng random(4);
  for (const double angle : {0.0, 0.1}) {
    Scene turning = flight();
    turning.R = Eigen::AngleAxisd(angle, Vec3::UnitY()).toRotationMatrix();
    turning.t.setZero();
    const auto agrees = agree_with_motion(points_of(turning, 60, 0, Vec3::Zero(), random), kSigma, kBaseline);
    ASSERT_TRUE(agrees);
    EXPECT_GE(std::ranges::count(*agrees, true), 58);
  }
}

TEST(MotionCheck, KnowsNothingWithoutAMajority) {
  Rng random(5);
  EXPECT_FALSE(agree_with_motion({}, kSigma, kBaseline));
  EXPECT_FALSE(agree_with_motion(points_of(flight(), 7, 0, Vec3::Zero(), random), kSigma, kBaseline));
  std::vector<MovedPoint> scattered = points_of(flight(), 60, 0, Vec3::Zero(), random);
  for (MovedPoint& point : scattered) point.now = {random.uniform(-0.7, 0.7), random.uniform(-0.5, 0.5)};
  EXPECT_FALSE(agree_with_motion(scattered, kSigma, kBaseline));
}

TEST(MotionCheck, OldTracksOutvoteYoungOnes) {
  Rng random(6);
  auto points = points_of(flight(), 100, 60, Vec3(0.4, 0.0, 0.0), random);
  for (int k = 0; k < 40; ++k) points[idx(k)].weight = 10.0;
  const auto agrees = agree_with_motion(points, kSigma, kBaseline);
  ASSERT_TRUE(agrees);
  EXPECT_GE(std::count(agrees->begin(), agrees->begin() + 40, true), 38);
  EXPECT_LE(std::count(agrees->begin() + 40, agrees->end(), true), 4);
}

TEST(MotionCheck, APointWithoutDepthMayBeAnywhereOnItsLine) {
  Rng random(7);
  auto points = points_of(flight(), 80, 20, Vec3(0.0, 0.4, 0.0), random);
  for (int k = 40; k < 80; ++k) {
    points[idx(k)].before /= points[idx(k)].before.z();
    points[idx(k)].has_depth = false;
  }
  const auto agrees = agree_with_motion(points, kSigma, kBaseline);
  ASSERT_TRUE(agrees);
  EXPECT_GE(std::count(agrees->begin(), agrees->begin() + 60, true), 58);
  EXPECT_LE(std::count(agrees->begin() + 60, agrees->end(), true), 5);
}

}  // namespace
}  // namespace tern
