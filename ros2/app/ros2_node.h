// tern-ros2: the bridge between the bus and ROS 2 as a process.
#pragma once

#include <string>
#include <vector>

#include "core/scenario/scenario.h"
#include "ros2/app/inlet.h"
#include "ros2/app/outlet.h"
#include "ros2/dds/participant.h"
#include "runtime/bus.h"
#include "runtime/node.h"

namespace tern::ros2 {

/// The options of tern-ros2.
struct Ros2Options {
  int domain = 0;
  std::string network;              ///< see Participant
  std::string name_space;           ///< see TopicNames
  std::vector<std::string> remaps;  ///< see TopicNames
  std::string send = "all";         ///< topics, separated by commas; "all" or "none"
  std::string receive = "none";     ///< topics, separated by commas
  ros::InletOptions in;
};

/// Reads a domain of ROS. @throws ConfigError unless it is a whole number of 0 … 232
int domain_of(const std::string& text);

/// Passes messages between the bus and ROS. It never waits for ROS, and no message of ROS ends it. A topic is either
/// received or sent, so no message returns to where it came from. With /odom, /tf is received only.
class Ros2Node final : public Node {
 public:
  /// @throws ConfigError for an unknown topic or a name that ROS forbids, or if DDS fails to start
  Ros2Node(Bus& bus, const UavSpec& uav, const Ros2Options& options);

  [[nodiscard]] UTime next_wakeup() const override { return next_; }
  void step(UTime now) override;
  [[nodiscard]] NodeHealth health() const override;

 private:
  Bus& bus_;
  TopicNames names_;
  Participant participant_;
  Outlet outlet_;
  Inlet inlet_;
  UTime next_, next_clock_, next_report_;
  UTime alone_until_;    ///< when the log says that nobody was met; kNever: it is said, or somebody was met
  std::string trouble_;  ///< of the last report
};

}  // namespace tern::ros2
