// Names of topics and types: as ROS users write them, and as ROS's middlewares write them into DDS.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace tern::ros2 {

/// The name of a topic in DDS: "/odom" is "rt/odom".
std::string dds_topic_name(std::string_view topic);
/// The name of a type in DDS: "nav_msgs/msg/Odometry" is "nav_msgs::msg::dds_::Odometry_".
std::string dds_type_name(std::string_view type);

/// How this vehicle's topics are called.
class TopicNames {
 public:
  /// @param name_space  "/drone1" stands before all topics but /tf, /tf_static and /clock; empty: none
  /// @param remaps  "odom:=/robot/odometry": a topic of Tern, and the whole name that it gets
  /// @return an Error that names the word: no name of ROS, or no topic of Tern
  static Result<TopicNames> parse(const std::string& name_space, const std::vector<std::string>& remaps,
                                  const std::vector<std::string>& known);
  /// Returns the topic's full name. @param topic  as Tern calls it: "/odom"
  [[nodiscard]] std::string of(const std::string& topic) const;

 private:
  std::string name_space_;
  std::map<std::string, std::string, std::less<>> remaps_;
};

}  // namespace tern::ros2
