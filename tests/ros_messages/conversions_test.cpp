// Values and the ROS messages that say the same.
#include "ros_messages/conversions.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numbers>

#include "ros_messages/feed.h"

namespace tern::ros {
namespace {

constexpr double kPi = std::numbers::pi;

TimedSpline some_trajectory() {
  TimedSpline trajectory{UTime{1'700'000'000'000'000}, Duration{250'000}, Points::Zero(3, 9)};
  for (int k = 0; k < 9; ++k) trajectory.control_points.col(k) << std::min(k, 6) * 1.25, std::sin(std::min(k, 6)), 2.0;
  return trajectory;
}

TEST(RosTime, CountsWholeSecondsDownwards) {
  EXPECT_EQ(to_ros(UTime{-1}).sec, -1);
  EXPECT_EQ(to_ros(UTime{-1}).nanosec, 999'999'000U);
  EXPECT_EQ(to_ros(UTime{2'000'003}).sec, 2);
  EXPECT_EQ(to_ros(UTime{2'000'003}).nanosec, 3'000U);
}

/// A vehicle that looks along +y and moves along +y goes forwards: along its own x.
TEST(RosOdometry, HasItsTwistInTheChildsFrame) {
  UavState state;
  state.motion.p = {1.0, 2.0, 3.0};
  state.motion.v = {0.0, 4.0, 0.5};
  state.yaw = kPi / 2;
  const Odometry odometry = odometry_of(state, Vec3(0.1, 0.2, 0.3), {});
  EXPECT_EQ(odometry.header.frame_id, "map");
  EXPECT_EQ(odometry.child_frame_id, "base_link");
  EXPECT_NEAR(odometry.twist.twist.linear.x, 4.0, 1e-12);
  EXPECT_NEAR(odometry.twist.twist.linear.y, 0.0, 1e-12);
  EXPECT_NEAR(odometry.twist.twist.linear.z, 0.5, 1e-12);
  EXPECT_NEAR(odometry.pose.covariance[0], 0.01, 1e-12);
  EXPECT_NEAR(odometry.pose.covariance[7], 0.04, 1e-12);
  EXPECT_NEAR(odometry.pose.covariance[14], 0.09, 1e-12);
  EXPECT_NEAR(odometry.pose.pose.orientation.z, std::sqrt(0.5), 1e-12);
}

TEST(RosDetections, HaveTheirWholeExtent) {
  ObservationSet frame;
  frame.detections = {{{1, 2, 3}, {0.5, 1.0, 1.5}, {0.01, 0.02, 0.03}, 7}, {{}, {}, {}, kNoTrackId}};
  const Detection3DArray array = detections_of(frame, {});
  ASSERT_EQ(array.detections.size(), 2U);
  EXPECT_EQ(array.detections[0].bbox.size.z, 3.0);
  EXPECT_EQ(array.detections[0].id, "7");
  EXPECT_EQ(array.detections[1].id, "");
}

TEST(RosTrajectory, IsThePlansOwnMotionFromStartToEnd) {
  const TimedSpline trajectory = some_trajectory();
  const MultiDOFJointTrajectory out = trajectory_of(trajectory, {});
  const Path path = path_of(trajectory, {});
  ASSERT_EQ(out.points.size(), path.poses.size());
  for (std::size_t k = 0; k < out.points.size(); ++k) {
    const MultiDOFJointTrajectoryPoint& point = out.points[k];
    const Duration after{point.time_from_start.sec * 1'000'000LL + point.time_from_start.nanosec / 1000};
    const MotionSample motion = trajectory.sample(trajectory.start + after);
    EXPECT_NEAR(point.transforms.at(0).translation.x, motion.p.x(), 1e-9);
    EXPECT_NEAR(point.velocities.at(0).linear.y, motion.v.y(), 1e-9);
    EXPECT_NEAR(point.accelerations.at(0).linear.x, motion.a.x(), 1e-9);
    EXPECT_NEAR(path.poses[k].pose.position.y, motion.p.y(), 1e-9);
  }
  EXPECT_EQ(path.poses.front().pose.position.x, trajectory.control_points(0, 0));
  EXPECT_DOUBLE_EQ(path.poses.back().pose.position.x, trajectory.control_points(0, 8));
}

TEST(RosCloud, HasAPointPerLabelledVoxel) {
  VoxelMap map;
  map.grid = {Vec3(1, 1, 1), 0.5, {2, 1, 1}};
  map.labels = {VoxelLabel::Free, VoxelLabel::Repulsive};
  map.classes = {0, 1};
  map.class_names = {"", "water"};
  const PointCloud2 cloud = cloud_of(map, UTime{0}, {});
  EXPECT_EQ(cloud.width, 1U);
  ASSERT_EQ(cloud.data.size(), 14U);
  EXPECT_EQ(cloud.data[12], 4);
  EXPECT_EQ(cloud.data[13], 1);
}

TEST(Feed, WritesOnlyWhatIsWanted) {
  std::vector<std::string> written;
  Feed feed([&](const FeedTopic& topic, const std::string&) { written.push_back(topic.name); },
            [](std::string_view topic) { return topic == topics::kTf; });
  feed.receive(UavState{});
  feed.receive(Goal{});
  EXPECT_EQ(written, std::vector<std::string>{"/tf"});
}

TEST(Feed, DrawsThePlanesOfAnOldRequestThatArrivesAgain) {
  std::vector<std::string> written;
  Feed feed([&](const FeedTopic& topic, const std::string&) { written.push_back(topic.name); },
            [](std::string_view topic) { return topic == topics::kPlanes; });
  HorizonRequest request;
  for (std::int64_t sequence = 1; sequence <= 100; ++sequence) {
    request.header.name = {1, sequence};
    feed.receive(request);
  }
  Plan plan;
  plan.outcome = PlanOutcome::Optimized;
  plan.inputs.request = {1, 3};
  feed.receive(plan);
  EXPECT_TRUE(written.empty()) << "only the newest requests are kept";
  request.header.name = {1, 3};  // a log was rewound
  feed.receive(request);
  feed.receive(plan);
  EXPECT_EQ(written, std::vector<std::string>{"/tern/planes"});
}

}  // namespace
}  // namespace tern::ros
