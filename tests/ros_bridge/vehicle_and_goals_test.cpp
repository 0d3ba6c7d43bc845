// The vehicle that odometry reports, and when goals are sent.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ros_bridge/goal_sender.h"
#include "ros_bridge/odometry_vehicle.h"

namespace tern::ros {
namespace {

using ::testing::HasSubstr;

constexpr UTime kBegin{1'000'000'000};

OdometryReading at(double seconds) {
  OdometryReading reading;
  reading.at = kBegin + Duration::from_seconds(seconds);
  reading.velocity = Vec3(2.0 + 3.0 * seconds, -1.0, 0.5 * seconds);
  reading.position = Vec3(2.0 * seconds + 1.5 * seconds * seconds, -seconds, 0.25 * seconds * seconds);
  return reading;
}

TEST(OdometryVehicle, DerivesTheAccelerationFromVelocities) {
  OdometryVehicle vehicle(false);
  EXPECT_EQ(vehicle.receive(at(0.00))->motion.a, Vec3::Zero());
  EXPECT_EQ(vehicle.receive(at(0.02))->motion.a, Vec3::Zero());
  for (int k = 2; k < 50; ++k) {
    const auto state = vehicle.receive(at(0.02 * k + 0.003 * (k % 3)));
    ASSERT_TRUE(state);
    EXPECT_LT((state->motion.a - Vec3(3.0, 0.0, 0.5)).norm(), 1e-9) << "whatever the spacing";
  }
  EXPECT_EQ(vehicle.status(at(1.0).at).resets, 0);
}

TEST(OdometryVehicle, RefusesWhatIsNotNewerAndCountsJumps) {
  OdometryVehicle vehicle(false);
  ASSERT_TRUE(vehicle.receive(at(0.1)));
  EXPECT_FALSE(vehicle.receive(at(0.1)));
  EXPECT_THAT(vehicle.receive(at(0.05)).error().message, HasSubstr("0.050 s before that of the last one"));
  OdometryReading jumped = at(0.12);
  jumped.position += Vec3(0.0, 0.5, 0.0);
  EXPECT_EQ(vehicle.receive(jumped)->motion.a, Vec3::Zero()) << "velocities from before the jump are not used";
  EXPECT_EQ(vehicle.status(jumped.at).resets, 1);
}

TEST(OdometryVehicle, FollowsWhileItsOdometryIsFreshAndItSaysSo) {
  OdometryVehicle vehicle(false), asking(true);
  EXPECT_EQ(vehicle.status(kBegin).why_not, "no odometry has come");
  for (OdometryVehicle* each : {&vehicle, &asking}) ASSERT_TRUE(each->receive(at(0.0)));
  EXPECT_TRUE(vehicle.status(at(0.3).at).following);
  EXPECT_FALSE(vehicle.status(at(0.301).at).following);
  EXPECT_THAT(vehicle.status(at(0.5).at).why_not, HasSubstr("0.5 s old"));
  EXPECT_THAT(asking.status(at(0.1).at).why_not, HasSubstr("/following does not say true"));
  asking.receive_following(true, at(0.1).at);
  EXPECT_TRUE(asking.status(at(0.2).at).following);
  ASSERT_TRUE(asking.receive(at(1.2)));
  EXPECT_FALSE(asking.status(at(1.2).at).following) << "it was said more than a second ago";
  asking.receive_following(true, at(1.2).at);
  asking.receive_following(false, at(1.21).at);
  EXPECT_FALSE(asking.status(at(1.22).at).following);
}

TEST(GoalSender, RepeatsAGoalUntilTheExecutorDoes) {
  GoalSender sender;
  EXPECT_FALSE(sender.due(kBegin));
  sender.ask(Vec3(1.0, 2.0, 3.0));
  const auto first = sender.due(kBegin);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->id, kBegin.us);
  sender.hear(*first, true);
  EXPECT_FALSE(sender.due(kBegin + Duration{500'000}));
  EXPECT_EQ(sender.due(kBegin + Duration{1'000'000})->id, first->id);
  sender.hear(*first, false);
  EXPECT_FALSE(sender.due(kBegin + Duration{3'000'000}));
}

TEST(GoalSender, GivesNewPositionsNewIdsAtMostTenTimesASecond) {
  GoalSender sender;
  Goal other;
  other.id = kBegin.us + 5'000'000;  // of a sender whose clock is ahead
  sender.hear(other, false);
  sender.ask(Vec3::Ones());
  const auto first = sender.due(kBegin);
  ASSERT_TRUE(first);
  EXPECT_GT(first->id, other.id);
  sender.ask(Vec3::Ones());
  EXPECT_FALSE(sender.due(kBegin + Duration{100'000})) << "the same position is the same goal";
  sender.ask(Vec3::Zero());
  sender.ask(Vec3(2.0, 0.0, 0.0));
  EXPECT_FALSE(sender.due(kBegin + Duration{50'000}));
  const auto second = sender.due(kBegin + Duration{100'000});
  ASSERT_TRUE(second);
  EXPECT_GT(second->id, first->id);
  EXPECT_EQ(second->position, Vec3(2.0, 0.0, 0.0)) << "the last one";
  other.id = second->id + 1;
  sender.hear(other, false);
  EXPECT_FALSE(sender.due(kBegin + Duration{5'000'000})) << "another operator's goal is newer";
}

}  // namespace
}  // namespace tern::ros
