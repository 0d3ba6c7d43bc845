#include "dimos/app/outlet.h"

#include <cstdint>
#include <span>

#include "dimos/channel.h"
#include "dimos/wire.h"
#include "ros_messages/cdr.h"

namespace tern::dimos {

const std::vector<OutPort>& out_ports() {
  using namespace ros::topics;
  static const std::vector<OutPort> kPorts = [] {
    std::vector<OutPort> ports = {{{"path", {type_name(ros::Path::kName)}}, kPlan}};
    for (const auto& [name, topic] : {std::pair{"markers_obstacles", kObstacles},
                                      {"markers_committed", kCommittedLine},
                                      {"markers_plan", kPlanLine},
                                      {"markers_hulls", kHulls},
                                      {"markers_planes", kPlanes},
                                      {"markers_regions", kRegions}}) {
      ports.push_back({{name, {type_name(ros::MarkerArray::kName)}}, topic});
    }
    return ports;
  }();
  return kPorts;
}

Outlet::Outlet(Bus& bus, DimosNetwork& network, const Placement& placement,
               const std::map<std::string, std::string>& channels)
    : network_(network),
      placement_(placement),
      next_repeat_(bus.clock().now()),
      feed_([this](const ros::FeedTopic& topic, const std::string& cdr) { write(topic, cdr); },
            [this](std::string_view topic) { return channels_.find(topic) != channels_.end(); }, {},
            ros::Drawings::Markers),
      bus_feed_(bus, feed_) {
  for (const OutPort& out : out_ports()) {
    const auto found = channels.find(out.port.name);
    if (found != channels.end()) channels_[out.topic] = found->second;
  }
}

void Outlet::write(const ros::FeedTopic& topic, const std::string& cdr) {
  const std::span bytes(reinterpret_cast<const std::uint8_t*>(cdr.data()), cdr.size());
  const std::string encoded = topic.name == ros::topics::kPlan
                                  ? encode(placement_.in_dimos(ros::decode_cdr<ros::Path>(bytes).value()))
                                  : encode(placement_.in_dimos(ros::decode_cdr<ros::MarkerArray>(bytes).value()));
  const std::string& channel = channels_.find(topic.name)->second;
  network_.publish(channel, encoded);
  if (topic.latched) kept_[channel] = encoded;
}

void Outlet::step(UTime now) {
  if (now < next_repeat_) return;
  next_repeat_ = now + kRepeat;
  for (const auto& [channel, bytes] : kept_) network_.publish(channel, bytes);
}

}  // namespace tern::dimos
