// Passes the messages of the bus to ROS.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>

#include "ros2/dds/participant.h"
#include "ros2/names.h"
#include "ros_bridge/app/bus_feed.h"
#include "ros_messages/feed.h"
#include "runtime/bus.h"

namespace tern::ros2 {

/// Returns a topic as DDS knows it, with its type's hash.
DdsTopic dds_topic(const ros::FeedTopic& topic, const TopicNames& names, const Qos& qos);

/// Writes the topics of docs/reference/ros_messages.md. A topic without readers costs nothing, except latched ones.
class Outlet {
 public:
  /// @param sent  topics that are written
  Outlet(Bus& bus, Participant& participant, const TopicNames& names, const std::set<std::string>& sent);
  Outlet(const Outlet&) = delete;
  Outlet& operator=(const Outlet&) = delete;

  /// Writes /clock, if it is sent.
  void write_clock(UTime now);
  /// Returns what slow or unfitting readers have cost, in words; empty: nothing new since the last call.
  std::string take_trouble();

 private:
  [[nodiscard]] bool is_wanted(std::string_view topic) const;
  void write(std::string_view topic, const std::string& cdr);

  Participant& participant_;
  struct Writer {
    int number = 0;
    bool latched = false;
    EndCounters reported;
  };
  std::map<std::string, Writer, std::less<>> writers_;  ///< by Tern's name of the topic
  ros::Feed feed_;
  ros::BusFeed bus_feed_;
};

}  // namespace tern::ros2
