// tern-logger: every message of every channel goes to the log.
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

/// What a kill can cost at most.
inline constexpr Duration kFlushPeriod{100'000};

/// The section `logger:` of a scenario file.
struct LoggerConfig {
  std::int64_t rotate_bytes =
      0;  ///< `rotate_mb` · 10⁶: a part of the log that is as long is followed by the next; 0: never
};

/// Reads and finishes the section. @throws ConfigError.
LoggerConfig read_logger_config(ConfigSection section);

/// Writes every message as it came, with the kernel's time of receipt, and hands it to the kernel every kFlushPeriod.
/// LCM's own receiving thread empties the socket meanwhile, so that a slow disk costs memory, not messages
/// (Bus::listen). What is larger than any reader takes (kLogMaxDataBytes; only fragments can be) is counted and left
/// out. A disk that takes nothing makes it Failed, with the reason in waiting_for; it goes on trying.
///
/// It is Ready when it has the CONFIGURATION of every one of Tern's processes whose heartbeat it hears: without them
/// nothing replays. Processes repeat theirs while it waits (NodeHost), and a simulator that is recorded waits for it.
class LoggerNode final : public Node {
 public:
  /// @param path  of the log; an existing folder means flight.lcm in it
  /// @throws ConfigError when the log cannot be made.
  LoggerNode(Bus& bus, const LoggerConfig& config, const std::string& path);
  /// Flushes and says a line per channel.
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

  /// The newest process of a name.
  struct Heard {
    UTime at;
    std::int64_t epoch_us = 0;
  };

  LogWriter writer_;
  ChannelTable table_;
  Bus& bus_;
  std::map<std::string, Heard> heard_;     ///< by process
  std::set<std::int64_t> configurations_;  ///< senders' epochs whose CONFIGURATION came
  UTime next_flush_;
  std::int64_t too_large_ = 0;
  std::string trouble_;  ///< why the last flush failed; empty when it did not
};

}  // namespace tern
