#include "ros2/topics.h"

#include <fmt/format.h>

namespace tern::ros2 {

const std::vector<ros::FeedTopic>& sent_topics() {
  static const std::vector<ros::FeedTopic> kTopics = [] {
    std::vector<ros::FeedTopic> all = ros::feed_topics(ros::Drawings::Markers);
    all.push_back({topics::kClock, &ros::ros_type<ros::Clock>()});
    return all;
  }();
  return kTopics;
}

const std::vector<ros::FeedTopic>& received_topics() {
  static const std::vector<ros::FeedTopic> kTopics = {{topics::kGoalPose, &ros::ros_type<ros::PoseStamped>()},
                                                      {topics::kOdom, &ros::ros_type<ros::Odometry>()},
                                                      {topics::kDetections, &ros::ros_type<ros::Detection3DArray>()},
                                                      {topics::kCloud, &ros::ros_type<ros::PointCloud2>()},
                                                      {topics::kOctomap, &ros::ros_type<ros::Octomap>(), true},
                                                      {topics::kFollowing, &ros::ros_type<ros::Bool>()}};
  return kTopics;
}

const std::vector<ros::FeedTopic>& transform_topics() {
  static const std::vector<ros::FeedTopic> kTopics = {{topics::kTf, &ros::ros_type<ros::TFMessage>()},
                                                      {topics::kTfStatic, &ros::ros_type<ros::TFMessage>(), true}};
  return kTopics;
}

Qos writer_qos(const ros::FeedTopic& topic) {
  constexpr int kDepth = 10, kTransforms = 100;  // as rclcpp and tf2 have them
  if (topic.latched) return {.reliable = true, .latched = true, .depth = 1};
  return {.reliable = true, .latched = false, .depth = topic.name == topics::kTf ? kTransforms : kDepth};
}

Qos reader_qos(const ros::FeedTopic& topic) {
  constexpr int kDepth = 10, kTransforms = 100, kClouds = 2;
  if (topic.name == topics::kOctomap) return {.reliable = true, .latched = true, .depth = 1};
  if (topic.latched) return {.reliable = true, .latched = true, .depth = kTransforms};
  if (topic.name == topics::kGoalPose) return {.reliable = true, .latched = false, .depth = kDepth};
  if (topic.name == topics::kTf) return {.reliable = false, .latched = false, .depth = kTransforms};
  if (topic.name == topics::kCloud) return {.reliable = false, .latched = false, .depth = kClouds};
  return {.reliable = false, .latched = false, .depth = kDepth};
}

std::string user_data(std::string_view sha256) { return fmt::format("typehash=RIHS01_{};", sha256); }

}  // namespace tern::ros2
