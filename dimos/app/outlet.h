// Passes the messages of the bus to DimOS.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "dimos/app/dimos_network.h"
#include "dimos/placement.h"
#include "ros_bridge/app/bus_feed.h"
#include "ros_messages/feed.h"
#include "runtime/bus.h"

namespace tern::dimos {

/// A port of the module: what DimOS's Python class calls it, and the types that its channel may have.
struct Port {
  std::string name;                ///< "goal_request"
  std::vector<std::string> types;  ///< "geometry_msgs.PoseStamped"
};

/// An output port: for paths or drawings.
struct OutPort {
  Port port;
  std::string topic;  ///< of the feed: "/plan"
};

/// The ports that Outlet serves.
const std::vector<OutPort>& out_ports();

/// Publishes paths and drawings, in DimOS's world. Drawings of the map change seldom: they are repeated every kRepeat
/// for readers that come later, as DimOS's channels keep nothing.
class Outlet {
 public:
  static constexpr Duration kRepeat{5'000'000};

  /// @param channels  by the ports' names; a port without a channel costs nothing
  Outlet(Bus& bus, DimosNetwork& network, const Placement& placement,
         const std::map<std::string, std::string>& channels);
  Outlet(const Outlet&) = delete;
  Outlet& operator=(const Outlet&) = delete;

  void step(UTime now);

 private:
  void write(const ros::FeedTopic& topic, const std::string& cdr);

  DimosNetwork& network_;
  Placement placement_;
  std::map<std::string, std::string, std::less<>> channels_;  ///< by the feed's topics
  std::map<std::string, std::string> kept_;                   ///< the newest bytes, by channel
  UTime next_repeat_;
  ros::Feed feed_;
  ros::BusFeed bus_feed_;
};

}  // namespace tern::dimos
