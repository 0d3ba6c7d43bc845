// How topics are called.
#include "ros2/names.h"

#include <gtest/gtest.h>

namespace tern::ros2 {
namespace {

TEST(Names, AreThoseOfRosMiddlewares) {
  EXPECT_EQ(dds_topic_name("/odom"), "rt/odom");
  EXPECT_EQ(dds_topic_name("/drone1/odom"), "rt/drone1/odom");
  EXPECT_EQ(dds_type_name("nav_msgs/msg/Odometry"), "nav_msgs::msg::dds_::Odometry_");
}

TEST(Names, OfTopicsTakeNamespaceAndRemaps) {
  const auto names = TopicNames::parse("/drone1", {"odom:=/robot/odometry", "/plan:=/p"}, {"/odom", "/plan", "/tf"});
  ASSERT_TRUE(names);
  EXPECT_EQ(names->of("/odom"), "/robot/odometry");
  EXPECT_EQ(names->of("/plan"), "/p");
  EXPECT_EQ(names->of("/setpoint"), "/drone1/setpoint");
  EXPECT_EQ(names->of("/tf"), "/tf");
  for (const char* wrong :
       {"odom", "odom:=odometry", "odom:=/a//b", "odom:=/a/", "odom:=/a b", "moon:=/x", "odom:=/1"}) {
    EXPECT_FALSE(TopicNames::parse("", {wrong}, {"/odom"})) << wrong;
  }
  EXPECT_FALSE(TopicNames::parse("drone", {}, {}));
}

}  // namespace
}  // namespace tern::ros2
