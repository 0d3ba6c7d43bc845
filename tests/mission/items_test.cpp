// Items of MAVLink missions as steps.
#include "mission/items.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/mission/some_site.h"

namespace tern::mission {
namespace {

using ::testing::HasSubstr;
using testing::some_site;

Item waypoint(double x, double y, double z) {
  Item item;
  item.number = 3;
  item.command = 16;
  item.frame = 4;  // W
  item.x = x;
  item.y = y;
  item.z = z;
  return item;
}

std::string refusal(const Item& item, const Site& site = some_site()) {
  const auto steps = steps_of({item}, site);
  return steps ? "" : steps.error().message;
}

TEST(MissionItems, APassBecomesAStopAtTheEnd) {
  const auto steps = steps_of({waypoint(1, 2, 3), waypoint(4, 5, 6)}, some_site()).value();
  ASSERT_EQ(steps.size(), 2u);
  EXPECT_EQ(steps[0].action, Action::Pass);
  EXPECT_EQ(steps[1].action, Action::Stop);
  EXPECT_EQ(steps[1].position, Vec3(4, 5, 6));
}

TEST(MissionItems, NedIsTurned) {
  Item item = waypoint(1, 2, -3);
  item.frame = 1;
  EXPECT_EQ(steps_of({item}, some_site())->front().position, Vec3(2, 1, 3));
}

TEST(MissionItems, AnAltitudeIsRelativeToTheOriginOrNot) {
  Item item = waypoint(testing::kOrigin.latitude, testing::kOrigin.longitude, 12.0);
  item.frame = 3;
  EXPECT_NEAR((steps_of({item}, some_site())->front().position - Vec3(0, 0, 12)).norm(), 0.0, 1e-6);
  item.frame = 0;
  item.z += testing::kOrigin.height;
  EXPECT_NEAR((steps_of({item}, some_site())->front().position - Vec3(0, 0, 12)).norm(), 0.0, 1e-6);
}

TEST(MissionItems, ALandingComesFromAboveAndStopsAboveTheGround) {
  Item land = waypoint(10, 0, 0);
  land.command = 21;
  const auto steps = steps_of({waypoint(0, 0, 8), land}, some_site()).value();
  ASSERT_EQ(steps.size(), 3u);
  EXPECT_EQ(steps[1].position, Vec3(10, 0, 8));
  EXPECT_EQ(steps[1].action, Action::Pass);
  EXPECT_EQ(steps[2].position, Vec3(10, 0, 1));
  EXPECT_EQ(steps[2].action, Action::Stop);
}

TEST(MissionItems, AReturnLeadsHome) {
  Item home;
  home.command = 20;
  home.frame = 2;
  const auto steps = steps_of({waypoint(10, 0, 8), home}, some_site()).value();
  ASSERT_EQ(steps.size(), 3u);
  EXPECT_EQ(steps[1].position, Vec3(0, 0, 8));
  EXPECT_EQ(steps[2].position, some_site().home);
}

TEST(MissionItems, ADelayIsAHoldAtTheStepBefore) {
  Item delay;
  delay.command = 93;
  delay.params[0] = 5.0;
  const auto steps = steps_of({waypoint(1, 2, 3), delay, waypoint(4, 5, 6)}, some_site()).value();
  ASSERT_EQ(steps.size(), 2u);
  EXPECT_EQ(steps[0].action, Action::Stop);
  EXPECT_EQ(steps[0].hold_s, 5.0);
}

/// As QGroundControl writes it.
Item change_speed(double speed) {
  Item item;
  item.number = 4;
  item.command = 178;
  item.frame = 2;
  item.params = {1.0, speed, -1.0, 0.0};
  return item;
}

TEST(MissionItems, ASpeedHoldsForTheStepsAfterIt) {
  const Item a = waypoint(1, 2, 3), b = waypoint(4, 5, 6), c = waypoint(7, 8, 9), d = waypoint(9, 9, 9);
  const auto steps =
      steps_of({a, change_speed(2.0), b, change_speed(-1.0), change_speed(3.0), c, change_speed(-2.0), d}, some_site())
          .value();
  ASSERT_EQ(steps.size(), 4u);
  const std::vector<double> speeds = {steps[0].speed, steps[1].speed, steps[2].speed, steps[3].speed};
  EXPECT_EQ(speeds, (std::vector<double>{0.0, 2.0, 3.0, 0.0}));
  for (int k = 0; k < 3; ++k) EXPECT_EQ(steps[idx(k)].action, Action::Pass);
}

TEST(MissionItems, SpeedsThatAreNotThoseOverTheGroundAreRefused) {
  EXPECT_EQ(refusal(change_speed(0.0)), "item 4, MAV_CMD_DO_CHANGE_SPEED (178): a speed of 0 m/s cannot be flown");
  EXPECT_THAT(refusal(change_speed(-3.0)), HasSubstr("a speed of -3 m/s is out of range [0.1, 100]"));
  Item item = change_speed(2.0);
  item.params[0] = 2.0;
  EXPECT_THAT(refusal(item), HasSubstr("param1 = 2 is not a ground speed (1)"));
  item = change_speed(2.0);
  item.params[2] = 50.0;
  EXPECT_THAT(refusal(item), HasSubstr("a throttle (param3 = 50) cannot be flown"));
}

/// QGroundControl writes a radius of 50 m for every vehicle.
TEST(MissionItems, AMulticopterLoitersOnTheSpot) {
  Item item = waypoint(1, 2, 3);
  item.command = 19;
  item.params = {30.0, 0.0, 50.0, 0.0};
  const auto steps = steps_of({item}, some_site()).value();
  EXPECT_EQ(steps[0].action, Action::Stop);
  EXPECT_EQ(steps[0].hold_s, 30.0);
}

TEST(MissionItems, WhatCannotBeFlownIsRefusedByName) {
  Item item = waypoint(1, 2, 3);
  item.command = 31'999;
  EXPECT_EQ(refusal(item), "item 3, MAV_CMD 31999: cannot be flown");
  item = waypoint(1, 2, 3);
  item.params[3] = 90.0;
  EXPECT_THAT(refusal(item), HasSubstr("MAV_CMD_NAV_WAYPOINT (16): a heading (param4 = 90) cannot be flown"));
  item = waypoint(1, 2, 3);
  item.frame = 10;
  EXPECT_THAT(refusal(item), HasSubstr("frame 10 is not supported"));
  item = waypoint(1, 2, 3);
  item.goes_on = false;
  EXPECT_THAT(refusal(item), HasSubstr("autoContinue"));
  item = waypoint(1, 2, std::nan(""));
  EXPECT_THAT(refusal(item), HasSubstr("has no altitude"));
  item = waypoint(2e5, 2, 3);
  EXPECT_THAT(refusal(item), HasSubstr("is farther than 100000 m from the origin"));
  item = waypoint(1, 2, 3);
  item.params[0] = -1.0;
  EXPECT_THAT(refusal(item), HasSubstr("a hold of -1 s is out of range [0, 86400]"));
  item = waypoint(95.0, 2, 3);
  item.frame = 3;
  EXPECT_THAT(refusal(item), HasSubstr("latitude 95 is out of range"));
  EXPECT_THAT(refusal(item, testing::site_without_origin()), HasSubstr("no origin"));
  EXPECT_EQ(steps_of({}, some_site()).error().message, "has no waypoint");
}

}  // namespace
}  // namespace tern::mission
