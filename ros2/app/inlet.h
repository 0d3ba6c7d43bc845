// Reads topics of ROS 2 for the bus.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "ros2/dds/participant.h"
#include "ros2/names.h"
#include "ros_bridge/app/ros_inlet.h"

namespace tern::ros2 {

/// Reads the topics that were asked for, and /tf if there is one. Bytes become messages in ros::RosInlet.
class Inlet {
 public:
  /// @param received  topics of received_topics()
  Inlet(Bus& bus, Participant& participant, const TopicNames& names, const std::set<std::string>& received,
        const ros::InletOptions& options, const UavSpec& uav);
  Inlet(const Inlet&) = delete;
  Inlet& operator=(const Inlet&) = delete;

  [[nodiscard]] bool is_empty() const { return readers_.empty(); }
  void step(UTime now);
  /// Returns what was refused since the last call, in words; empty: nothing.
  std::string take_trouble();
  /// Returns what the vehicle lacks, in words; empty: nothing.
  [[nodiscard]] std::string waiting_for(UTime now) const { return inlet_.waiting_for(now); }

 private:
  struct Reader {
    std::string topic;
    ros::Input input{};
    int number = 0;
    EndCounters reported;
    UTime next{};  ///< when it is read again
  };
  void receive(Reader& reader, UTime now);

  Participant& participant_;
  ros::RosInlet inlet_;
  std::vector<Reader> readers_;
};

}  // namespace tern::ros2
