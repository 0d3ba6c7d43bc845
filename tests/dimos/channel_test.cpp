// Names of DimOS's channels, and poses in its world.
#include "dimos/channel.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <regex>

#include "dimos/placement.h"
#include "ros_bridge/transforms.h"

namespace tern::dimos {
namespace {

using ::testing::HasSubstr;

TEST(Channels, NameTheirTypes) {
  EXPECT_EQ(type_name(ros::PoseStamped::kName), "geometry_msgs.PoseStamped");
  const std::vector<std::string> types = {"geometry_msgs.PoseStamped", "nav_msgs.Odometry"};
  EXPECT_EQ(type_of_channel("/odom#nav_msgs.Odometry", types), "nav_msgs.Odometry");
  EXPECT_EQ(type_of_channel("/a/b#geometry_msgs.PoseStamped", types), "geometry_msgs.PoseStamped");
  const auto why = [&](const std::string& channel) { return type_of_channel(channel, types).error().message; };
  EXPECT_THAT(why("/odom"), HasSubstr("write it as /topic#geometry_msgs.PoseStamped"));
  EXPECT_THAT(why("odom#nav_msgs.Odometry"), HasSubstr("is no channel of DimOS"));
  EXPECT_THAT(why("#nav_msgs.Odometry"), HasSubstr("is no channel of DimOS"));
  EXPECT_THAT(why("/odom#nav_msgs.Path"), HasSubstr("must be geometry_msgs.PoseStamped or nav_msgs.Odometry"));
  EXPECT_THAT(why("/" + std::string(60, 'x') + "#nav_msgs.Odometry"), HasSubstr("LCM allows 63"));
}

TEST(Channels, ArePatternsOfThemselvesAlone) {
  const std::regex pattern(pattern_of("/odom#nav_msgs.Odometry"));
  EXPECT_TRUE(std::regex_match("/odom#nav_msgs.Odometry", pattern));
  EXPECT_FALSE(std::regex_match("/odom#nav_msgsxOdometry", pattern));
  EXPECT_FALSE(std::regex_match("/odom2#nav_msgs.Odometry", pattern));
}

/// DimOS's MAVLink drone: x north, y west, so W = (start.x − y, start.y + x, z).
TEST(Placements, TurnNorthWestUpIntoEastNorthUpAndBack) {
  const Placement placement("world", Vec3(10.0, 20.0, 0.0), M_PI / 2);
  ros::TransformBuffer buffer;
  ASSERT_TRUE(buffer.add(placement.transform(), true, UTime{}));
  const Vec3 p_D(3.0, 4.0, 5.0);
  const Vec3 p_W = (*buffer.find(kTernFrame, "world", UTime{}))(p_D);
  EXPECT_LT((p_W - Vec3(10.0 - 4.0, 20.0 + 3.0, 5.0)).norm(), 1e-12);

  ros::Path path;
  path.poses.push_back({{{}, "map"}, {{p_W.x(), p_W.y(), p_W.z()}, {0.0, 0.0, std::sqrt(0.5), std::sqrt(0.5)}}});
  const ros::Path out = placement.in_dimos(path);
  EXPECT_EQ(out.header.frame_id, "world");
  EXPECT_EQ(out.poses[0].header.frame_id, "world");
  const auto& p = out.poses[0].pose.position;
  EXPECT_LT((Vec3(p.x, p.y, p.z) - p_D).norm(), 1e-12);
  EXPECT_NEAR(out.poses[0].pose.orientation.w, 1.0, 1e-12) << "north in W is ahead in DimOS's world";

  ros::MarkerArray markers;
  markers.markers.resize(1);
  markers.markers[0].points.push_back({p_W.x(), p_W.y(), p_W.z()});
  const ros::MarkerArray turned = placement.in_dimos(markers);
  const ros::Marker& marker = turned.markers[0];
  const auto pose = ros::read_pose(marker.pose);
  ASSERT_TRUE(pose);
  const ros::Point& point = marker.points[0];
  EXPECT_LT(((*pose)(Vec3(point.x, point.y, point.z)) - p_D).norm(), 1e-12) << "points are in the marker's pose";
}

}  // namespace
}  // namespace tern::dimos
