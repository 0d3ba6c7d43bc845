#include "logger/app/logger_node.h"

#include <fmt/format.h>

#include <filesystem>
#include <span>
#include <string_view>

#include "flight_log/log_format.h"
#include "messages/codec.h"
#include "runtime/log.h"
#include "runtime/roles.h"

namespace tern {
namespace {

/// A process that is silent for longer has ended: four heartbeats in a row are missing.
constexpr Duration kHeartbeatAge{2'500'000};

LogWriter open_writer(std::string path, std::int64_t rotate_bytes) {
  if (std::filesystem::is_directory(path)) path = (std::filesystem::path(path) / "flight.lcm").string();
  return value_or_throw(LogWriter::open(path, rotate_bytes), "--record ");
}

}  // namespace

LoggerConfig read_logger_config(ConfigSection section) {
  LoggerConfig config;
  config.rotate_bytes =
      section.integer("rotate_mb", 1'000, 0, 1'000'000, "size at which a new part of the log begins, MB; 0: never") *
      1'000'000;
  section.finish();
  return config;
}

LoggerNode::LoggerNode(Bus& bus, const LoggerConfig& config, const std::string& path, bool* is_whole)
    : writer_(open_writer(path, config.rotate_bytes)),
      table_(bus.suffix()),
      bus_(bus),
      is_whole_(is_whole),
      next_flush_(bus.clock().now()) {
  log::info("writing {}", writer_.part_path());
  bus.listen([this](std::string_view channel, std::int64_t system_us, std::span<const std::uint8_t> data) {
    // By the flight's clock, like all times in its messages.
    const UTime received = bus_.clock().at_system_time(system_us);
    table_.add(channel, received, data);
    if (data.size() > kLogMaxDataBytes) {
      ++too_large_;
      return;
    }
    writer_.append(channel, received.us, data);
  });
  bus.subscribe(channels::kHeartbeat, [this](const Heartbeat& heartbeat) {
    if (!role_of_process(heartbeat.process)) return;
    starts_[heartbeat.process] = {bus_.received(), heartbeat.header.name.sender_epoch_us};
  });
  bus.subscribe(channels::kConfiguration, [this](const ConfigurationReport& report) {
    const bool is_ours = role_of_process(report.process).has_value();
    if (is_ours) configurations_.insert(report.header.name.sender_epoch_us);
  });
}

LoggerNode::~LoggerNode() {
  flush();
  report();
  if (is_whole_ != nullptr) *is_whole_ = trouble_.empty();
}

void LoggerNode::step(UTime now) {
  if (now < next_flush_) return;
  flush();
  next_flush_ = now + kFlushPeriod;
}

void LoggerNode::flush() {
  const auto flushed = writer_.flush();
  const bool was_well = trouble_.empty();
  trouble_ = flushed ? "" : flushed.error().message;
  if (const std::int64_t lost = writer_.counters().unwritten; lost > 0) {
    trouble_ = fmt::format("{} messages are not in the log: {}", lost, writer_.trouble());
  }
  if (was_well && !trouble_.empty()) log::error("{}", trouble_);
}

std::string LoggerNode::missing_configurations() const {
  std::string text;
  for (const auto& [process, start] : starts_) {
    if (bus_.clock().now() - start.at > kHeartbeatAge || configurations_.contains(start.epoch_us)) continue;
    text += (text.empty() ? "CONFIGURATION of " : ", ") + process;
  }
  return text;
}

NodeHealth LoggerNode::health() const {
  if (!trouble_.empty()) return {ProcessState::Failed, trouble_};
  const std::string missing = missing_configurations();
  return {missing.empty() ? ProcessState::Ready : ProcessState::Waiting, missing};
}

void LoggerNode::report() const {
  const LogWriterCounters& counters = writer_.counters();
  log::info("{} messages, {:.1f} MB in {} file(s), {} not written, {} too large for a log", counters.written,
            static_cast<double>(counters.bytes) * 1e-6, counters.parts, counters.unwritten, too_large_);
  for (const auto& [channel, count] : table_.counts()) {
    log::info("{:<24} received {:>8}  lost {:>6}  refused {:>4}  {:>9.3f} MB", channel, count.received, count.lost,
              count.refused, static_cast<double>(count.bytes) * 1e-6);
  }
}

}  // namespace tern
