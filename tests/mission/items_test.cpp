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

TEST(MissionItems, WhatCannotBeFlownIsRefusedByName) {
  Item item = waypoint(1, 2, 3);
  item.command = 178;
  EXPECT_EQ(refusal(item),
            "item 3, MAV_CMD_DO_CHANGE_SPEED (178): a speed cannot be flown; the vehicle flies at uav.limits.v_max of "
            "the scenario: set that, and leave the speed out");
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
