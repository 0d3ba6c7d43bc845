// tern-logger: writes every message of every channel to the log.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>

#include "flight_log/log_writer.h"
#include "logger/channel_table.h"
#include "runtime/bus.h"
#include "runtime/config.h"
#include "runtime/node.h"

namespace tern {

/// Exit code of tern-logger if messages are missing in its log.
inline constexpr int kExitMessagesMissing = 5;
/// Time between flushes: a kill loses the messages of at most this time.
inline constexpr Duration kFlushPeriod{100'000};

/// The section `logger:` of a scenario file.
struct LoggerConfig {
  /// `rotate_mb` · 10⁶: a part of the log that has this length is followed by a new part; 0: never
  std::int64_t rotate_bytes = 0;
};

/// Reads the section and refuses unknown keys. @throws ConfigError.
LoggerConfig read_logger_config(ConfigSection section);

/// Writes every message as it came, with the kernel's time of receipt, and flushes every kFlushPeriod.
///
/// - LCM's receiving thread empties the socket meanwhile. So a slow disk costs memory, not messages (Bus::listen).
/// - A message longer than kLogMaxDataBytes, which no reader takes (only LCM fragments can be), is counted and left
///   out.
/// - If the disk takes no data, the node is Failed, with the reason in waiting_for. It continues to try, but stays
///   Failed: from then on the recording is incomplete. No flight begins with such a recording.
/// - The node is Ready when it has the CONFIGURATION of every process of Tern whose heartbeat it receives: without them
///   a flight cannot be replayed. Processes repeat theirs while it waits (NodeHost), and a recorded simulator waits for
///   it.
class LoggerNode final : public Node {
 public:
  /// @param path  of the log; for an existing folder, flight.lcm in it
  /// @param is_whole  the destructor writes there whether the log holds every message; null: nowhere
  /// @throws ConfigError if the log cannot be made.
  LoggerNode(Bus& bus, const LoggerConfig& config, const std::string& path, bool* is_whole = nullptr);
  /// Flushes, and prints a line per channel.
  ~LoggerNode() override;
  LoggerNode(const LoggerNode&) = delete;
  LoggerNode& operator=(const LoggerNode&) = delete;

  [[nodiscard]] UTime next_wakeup() const override { return next_flush_; }
  void step(UTime now) override;
  [[nodiscard]] NodeHealth health() const override;

  [[nodiscard]] const ChannelTable& table() const { return table_; }
  [[nodiscard]] const LogWriterCounters& counters() const { return writer_.counters(); }

 private:
  void flush();
  void report() const;
  [[nodiscard]] std::string missing_configurations() const;

  /// The newest start of a process name.
  struct Start {
    UTime at;
    std::int64_t epoch_us = 0;
  };

  LogWriter writer_;
  ChannelTable table_;
  Bus& bus_;
  std::map<std::string, Start> starts_;    ///< by process name
  std::set<std::int64_t> configurations_;  ///< epochs of the senders whose CONFIGURATION arrived
  bool* is_whole_;
  UTime next_flush_;
  std::int64_t too_large_ = 0;
  std::string trouble_;  ///< why messages are not in the log, or why the last flush failed; empty: neither
};

}  // namespace tern
