#include <fmt/format.h>

#include <algorithm>

#include "core/base/digest.h"
#include "runtime/channels.h"
#include "runtime/process.h"
#include "runtime/version.h"

namespace tern {
namespace {

constexpr Duration kHeartbeatPeriod{500'000};
constexpr Duration kConfigurationPeriod{5'000'000};
/// What of kMaxMessageBytes a CONFIGURATION's text may take; the rest is for its other fields.
constexpr std::size_t kMaxYamlBytes = kMaxMessageBytes - 2'000;

std::string cut_to_fit(const std::string& yaml) {
  if (yaml.size() <= kMaxYamlBytes) return yaml;
  std::size_t end = yaml.rfind('\n', kMaxYamlBytes - 100);
  end = end == std::string::npos ? 0 : end + 1;
  return yaml.substr(0, end) + fmt::format("# cut here: {} of {} bytes are shown\n", end, yaml.size());
}

}  // namespace

NodeHost::NodeHost(Bus& bus, Node& node, std::string process, std::string effective_yaml)
    : bus_(bus), node_(node), process_(std::move(process)), yaml_(std::move(effective_yaml)) {
  next_heartbeat_ = next_configuration_ = bus.clock().now();
}

UTime NodeHost::next_wakeup() const {
  return std::min({node_.next_wakeup(), next_heartbeat_, next_configuration_, bus_.next_due()});
}

bool NodeHost::is_due(UTime now) const { return next_wakeup() <= now || bus_.deliveries() != stepped_deliveries_; }

void NodeHost::step(UTime now) {
  if (node_.next_wakeup() <= now || bus_.deliveries() != stepped_deliveries_) {
    stepped_deliveries_ = bus_.deliveries();
    node_.step(now);
  }
  if (node_.finished() && !said_finished_) {
    said_finished_ = true;
    next_heartbeat_ = now;
  }
  if (next_configuration_ <= now) {
    next_configuration_ = now + kConfigurationPeriod;
    publish_configuration();
  }
  if (next_heartbeat_ <= now) {
    next_heartbeat_ = now + kHeartbeatPeriod;
    publish_heartbeat();
  }
  bus_.send_due(now);
}

void NodeHost::publish_heartbeat() {
  const NodeHealth health = node_.health();
  Heartbeat message;
  message.process = process_;
  message.build_id = build_id();
  message.state = health.state;
  message.waiting_for = health.waiting_for;
  message.channels = bus_.counters();
  bus_.publish(channels::kHeartbeat, message);
}

void NodeHost::publish_configuration() {
  ConfigurationReport message;
  message.process = process_;
  message.build_id = build_id();
  message.yaml = cut_to_fit(yaml_);
  message.hash = digest(yaml_);
  bus_.publish(channels::kConfiguration, message);
}

}  // namespace tern
