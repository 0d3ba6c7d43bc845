#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "core/base/digest.h"
#include "core/base/plain_text.h"
#include "core/wire/message_limits.h"
#include "messages/codec.h"
#include "runtime/log.h"
#include "runtime/platform.h"
#include "runtime/process.h"
#include "runtime/version.h"

namespace tern {
namespace {

constexpr std::string_view kRecorder = "tern-logger";
constexpr Duration kHeartbeatPeriod{500'000};
constexpr Duration kConfigurationPeriod{5'000'000};
/// Space for the last line of a shortened text.
constexpr std::size_t kCutLineBytes = 120;
constexpr std::size_t kMaxNote = 200;  ///< bytes

/// Appends `trouble` if it fits.
void append(std::string& waiting_for, const std::string& trouble) {
  const std::string separator = waiting_for.empty() ? "" : "; ";
  if (trouble.empty() || waiting_for.size() + separator.size() + trouble.size() > kMaxWaitingText) return;
  waiting_for += separator + trouble;
}

/// Appends the notes as comments, as many as fit; a last line says if some do not.
std::string with_notes(std::string yaml, const std::vector<std::string>& notes) {
  for (std::size_t k = 0; k < notes.size(); ++k) {
    std::string line = "# " + plain_text(notes[k], kMaxNote);
    std::ranges::replace(line, '\n', ' ');
    if (yaml.size() + line.size() + 1 + kCutLineBytes > kMaxYamlText) {
      const std::string cut = fmt::format("# cut here: {} of {} notes\n", k, notes.size());
      return yaml.size() + cut.size() <= kMaxYamlText ? yaml + cut : yaml;
    }
    yaml += line + '\n';
  }
  return yaml;
}

Duration magnitude(Duration d) { return d < Duration{} ? d * -1 : d; }

}  // namespace

std::string reported_yaml(const std::string& effective_yaml) {
  if (effective_yaml.size() <= kMaxYamlText) return effective_yaml;
  const std::size_t line_end = effective_yaml.rfind('\n', kMaxYamlText - kCutLineBytes);
  const std::size_t kept = line_end == std::string::npos ? 0 : line_end + 1;
  return effective_yaml.substr(0, kept) + fmt::format("# cut here: {} of {} bytes; digest of the whole {:016x}\n", kept,
                                                      effective_yaml.size(), digest(effective_yaml));
}

std::uint64_t configuration_hash(const std::string& effective_yaml) { return digest(reported_yaml(effective_yaml)); }

NodeHost::NodeHost(Bus& bus, Node& node, std::string process, const std::string& effective_yaml)
    : bus_(bus),
      node_(node),
      process_(std::move(process)),
      yaml_(with_notes(reported_yaml(effective_yaml), node.notes())) {
  last_heartbeat_ = next_heartbeat_ = next_configuration_ = bus.clock().now();
  bus_.subscribe(channels::kHeartbeat, [this](const Heartbeat& m) { on_heartbeat(m); });
}

void NodeHost::on_heartbeat(const Heartbeat& heartbeat) {
  const Header& header = heartbeat.header;
  if (heartbeat.process == kRecorder && heartbeat.state == ProcessState::Waiting) {
    next_configuration_ = std::min(next_configuration_, bus_.clock().now());
  }
  if (header.name.sender_epoch_us == bus_.epoch_us() || !echoes_.receive(header, bus_.received())) return;
  next_heartbeat_ = std::min(next_heartbeat_, last_heartbeat_ + kHeartbeatSpacing);
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
  if (node_.finished() && !reported_finished_) {
    reported_finished_ = true;
    next_heartbeat_ = now;
  }
  if (next_configuration_ <= now) {
    next_configuration_ = now + kConfigurationPeriod;
    publish_configuration();
  }
  if (next_heartbeat_ <= now) {
    last_heartbeat_ = now;
    next_heartbeat_ = now + kHeartbeatPeriod;
    publish_heartbeat();
  }
  bus_.send_due(now);
}

/// @return the drift of the system's clock in words, or ""; a new drift is also logged.
std::string NodeHost::report_drift() {
  const Duration drift = bus_.clock().drift();
  if (magnitude(drift) <= kReportedDrift) {
    reported_drift_ = {};
    return "";
  }
  std::string text =
      fmt::format("the system's clock was set {} by {:.1f} ms since this process started: restart all processes",
                  drift < Duration{} ? "back" : "forward", magnitude(drift).seconds() * 1e3);
  if (magnitude(drift - reported_drift_) > kReportedDrift) {
    log::warn("{}", text);
    reported_drift_ = drift;
  }
  return text;
}

void NodeHost::log_long_wait(const NodeHealth& health) {
  if (health.state != ProcessState::Waiting) {
    waits_since_.reset();
    logged_wait_ = false;
    return;
  }
  if (!waits_since_) waits_since_ = bus_.clock().now();
  if (logged_wait_ || bus_.clock().now() - *waits_since_ < kLongWait) return;
  logged_wait_ = true;
  log::info("has been waiting for {:.0f} s: {}", kLongWait.seconds(), health.waiting_for);
}

void NodeHost::publish_heartbeat() {
  const NodeHealth health = node_.health();
  log_long_wait(health);
  Heartbeat message;
  message.process = process_;
  message.build_id = build_id();
  message.state = health.state;
  message.waiting_for = health.waiting_for;
  for (const std::string& trouble : {report_drift(), bus_.sender_troubles()}) append(message.waiting_for, trouble);
  message.waiting_for = plain_text(message.waiting_for, kMaxWaitingText);  // receivers would refuse anything else
  message.channels = bus_.counters();
  message.echoes = echoes_.echoes(bus_.clock().now());
  bus_.publish(channels::kHeartbeat, message);
}

void NodeHost::publish_configuration() {
  ConfigurationReport message;
  message.process = process_;
  message.build_id = build_id();
  message.platform = platform();
  message.yaml = yaml_;
  message.hash = digest(yaml_);
  bus_.publish(channels::kConfiguration, message);
}

}  // namespace tern
