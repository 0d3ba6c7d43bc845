// The velocity of poses alone.
#include "ros_bridge/pose_velocity.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

namespace tern::ros {
namespace {

OdometryReading at(double seconds, const Vec3& position) {
  OdometryReading reading;
  reading.at = UTime{1'000'000'000} + Duration::from_seconds(seconds);
  reading.position = position;
  return reading;
}

RC_GTEST_PROP(PoseVelocity, IsThatOfAStraightLineWhateverTheSpacing, ()) {
  const double rate = *rc::gen::inRange(11, 200);
  const Vec3 v(*rc::gen::inRange(-9, 10), *rc::gen::inRange(-9, 10), *rc::gen::inRange(-9, 10));
  PoseVelocity velocity;
  Vec3 found = Vec3::Constant(1e9);
  double t = 0.0;
  for (int k = 0; k < 100; ++k) {
    t += (0.5 + 0.005 * static_cast<double>(*rc::gen::inRange(0, 100))) / rate;
    if (const auto slope = velocity.receive(at(t, Vec3(1.0, 2.0, 3.0) + t * v))) found = *slope;
  }
  RC_ASSERT((found - v).norm() < 1e-3);  // stamps are whole microseconds
}

TEST(PoseVelocity, LagsByHalfOfItsWindow) {
  PoseVelocity velocity;
  std::optional<Vec3> found;
  for (int k = 0; k <= 90; ++k) {
    const double t = k / 30.0;
    found = velocity.receive(at(t, Vec3(t * t, 0.0, 0.0)));  // 2 m/s²
  }
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->x(), 2.0 * (3.0 - 0.5 * PoseVelocity::kWindow.seconds()), 0.05);
}

TEST(PoseVelocity, IsUnknownUntilReadingsSpanATenthOfASecondAndAfterAJump) {
  PoseVelocity velocity;
  EXPECT_FALSE(velocity.receive(at(0.00, Vec3::Zero())));
  EXPECT_FALSE(velocity.receive(at(0.01, Vec3::Zero())));
  EXPECT_FALSE(velocity.receive(at(0.02, Vec3::Zero())));
  EXPECT_EQ(velocity.receive(at(0.10, Vec3::Zero())), Vec3::Zero());
  EXPECT_EQ(velocity.receive(at(0.05, Vec3::Ones())), Vec3::Zero()) << "an older one is left out";
  EXPECT_FALSE(velocity.receive(at(0.12, Vec3(0.0, 0.4, 0.0)))) << "a jump is no velocity";
  EXPECT_FALSE(velocity.receive(at(0.17, Vec3(0.0, 0.4, 0.0))));
  EXPECT_EQ(velocity.receive(at(0.22, Vec3(0.0, 0.4, 0.0))), Vec3::Zero());
  EXPECT_FALSE(velocity.receive(at(2.0, Vec3(0.0, 0.4, 0.0)))) << "after a gap it begins anew";
}

}  // namespace
}  // namespace tern::ros
