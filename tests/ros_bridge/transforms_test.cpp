// Poses of frames over time.
#include "ros_bridge/transforms.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "ros_messages/conversions.h"
#include "tests/ros_bridge/made_up.h"

namespace tern::ros {
namespace {

using ::testing::HasSubstr;

constexpr UTime kNow{50'000'000};

TEST(Transforms, ChainFramesUpAndDown) {
  TransformBuffer buffer;
  std::mt19937_64 rng(1);
  for (int k = 0; k < 200; ++k) {
    // map ← odom ← base_link ← camera, and map ← town
    const RigidTransform T_MO = any_pose(rng), T_OB = any_pose(rng), T_BC = any_pose(rng), T_MT = any_pose(rng);
    ASSERT_TRUE(buffer.add(transform_of("map", "odom", T_MO, kNow), false, kNow));
    ASSERT_TRUE(buffer.add(transform_of("odom", "base_link", T_OB, kNow), false, kNow));
    ASSERT_TRUE(buffer.add(transform_of("base_link", "camera", T_BC, UTime{}), true, kNow));
    ASSERT_TRUE(buffer.add(transform_of("map", "town", T_MT, kNow), false, kNow));
    const Vec3 x = Vec3::Random();
    const Vec3 in_map = T_MO(T_OB(T_BC(x)));
    const auto up = buffer.find("map", "camera", kNow), across = buffer.find("town", "camera", kNow);
    ASSERT_TRUE(up && across);
    EXPECT_LT(((*up)(x)-in_map).norm(), 1e-12);
    EXPECT_LT((T_MT((*across)(x)) - in_map).norm(), 1e-12);
  }
}

TEST(Transforms, InterpolateAndNeverExtrapolate) {
  TransformBuffer buffer;
  const UTime begin = kNow - Duration{1'000'000};
  for (int k = 10; k >= 0; --k) {  // in any order
    const double angle = 0.1 * k;
    RigidTransform pose{Eigen::Quaterniond(Eigen::AngleAxisd(angle, Vec3::UnitZ())), Vec3(k, 2.0 * k, 0.0)};
    ASSERT_TRUE(buffer.add(transform_of("map", "base_link", pose, begin + Duration{100'000LL * k}), false, kNow));
  }
  const auto middle = buffer.find("map", "base_link", begin + Duration{425'000});
  ASSERT_TRUE(middle);
  EXPECT_LT((middle->p - Vec3(4.25, 8.5, 0.0)).norm(), 1e-12);
  EXPECT_NEAR(Eigen::AngleAxisd(middle->q).angle(), 0.425, 1e-12);
  EXPECT_EQ(buffer.find("map", "base_link", begin)->p, Vec3(0.0, 0.0, 0.0));
  const auto before = buffer.find("map", "base_link", begin - Duration{1});
  const auto after = buffer.find("map", "base_link", kNow + Duration{2'000});
  ASSERT_FALSE(before || after);
  EXPECT_THAT(after.error().message, HasSubstr("the newest pose of base_link in map is 0.002 s too old"));
  EXPECT_EQ(buffer.find("map", "base_link", std::nullopt)->p, Vec3(10.0, 20.0, 0.0)) << "the newest";
}

TEST(Transforms, NameWhatIsMissing) {
  TransformBuffer buffer;
  ASSERT_TRUE(buffer.add(transform_of("a", "b", {}, kNow), false, kNow));
  ASSERT_TRUE(buffer.add(transform_of("b", "a", {}, kNow), false, kNow));
  EXPECT_THAT(buffer.find("map", "b", kNow).error().message, HasSubstr("form a circle"));
  EXPECT_THAT(buffer.find("map", "moon", kNow).error().message, HasSubstr("no transform leads from moon to map"));
  EXPECT_TRUE(buffer.find("map", "map", kNow)) << "a frame in itself";
}

TEST(Transforms, RefuseWhatIsNoPose) {
  TransformBuffer buffer;
  const auto why = [&](const ros::TransformStamped& t) {
    const auto added = buffer.add(t, false, kNow);
    return added ? std::string() : added.error().message;
  };
  auto t = transform_of("map", "x", {}, kNow);
  t.transform.rotation = {0.0, 0.0, 0.0, 0.0};
  EXPECT_THAT(why(t), HasSubstr("length 0, not 1"));
  t = transform_of("map", "x", {}, kNow);
  t.transform.translation.y = std::nan("");
  EXPECT_THAT(why(t), HasSubstr("is no place"));
  EXPECT_THAT(why(transform_of("x", "x", {}, kNow)), HasSubstr("has no two frames"));
  EXPECT_THAT(why(transform_of("map", "", {}, kNow)), HasSubstr("has no two frames"));
  EXPECT_THAT(why(transform_of("map", "x", {}, kNow + Duration{2'200'000})), HasSubstr("2.200 s ahead"));
  EXPECT_THAT(why(transform_of("map", "x", {}, kNow - Duration{11'000'000})), HasSubstr("11.000 s old"));
}

TEST(Transforms, DatedIntoTheFutureServeThePresent) {
  TransformBuffer buffer;
  UTime now = kNow;
  for (int k = 0; k < 100; ++k, now = now + Duration{50'000}) {  // as SLAM systems publish map → odom
    ASSERT_TRUE(buffer.add(transform_of("map", "odom", {}, now + Duration{1'900'000}), false, now));
    ASSERT_TRUE(buffer.add(transform_of("odom", "base_link", {}, now), false, now));
    EXPECT_EQ(buffer.find("map", "base_link", now).has_value(), k >= 38) << k;
  }
}

TEST(Transforms, ForgetWhatIsOldAndTakeNoMoreThanTheirLimits) {
  TransformBuffer buffer;
  UTime now = kNow;
  for (int k = 0; k < 5'000; ++k) {
    now = now + Duration{10'000};
    ASSERT_TRUE(buffer.add(transform_of("map", "base_link", {}, now), false, now));
  }
  EXPECT_TRUE(buffer.find("map", "base_link", now - Duration{9'900'000}));
  EXPECT_FALSE(buffer.find("map", "base_link", now - Duration{10'100'000}));
  std::size_t taken = 0;
  for (int k = 0; k < 2'000; ++k) {
    taken += static_cast<std::size_t>(
        buffer.add(transform_of("map", "frame" + std::to_string(k), {}, now), false, now).has_value());
  }
  EXPECT_EQ(taken, TransformBuffer::kMaxFrames - 1);
}

}  // namespace
}  // namespace tern::ros
