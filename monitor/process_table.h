// Every process by its heartbeats: alive, restarted, what its channels lost.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "core/base/time.h"
#include "core/world/health.h"

namespace tern {

/// A channel's messages over all processes that listen to it.
struct MessageCount {
  std::int64_t received = 0;  ///< accepted
  std::int64_t rejected = 0;  ///< refused, whatever the reason
  std::int64_t lost = 0;      ///< gaps in sequence numbers
};

/// Keeps the newest heartbeat of each start (sender epoch) of each process, so that the counts of one that died are
/// kept.
class ProcessTable {
 public:
  /// @param now  the listener's clock
  void add(const Heartbeat& heartbeat, UTime now);

  /// When a process was heard last; nothing if never.
  [[nodiscard]] std::optional<UTime> heard(const std::string& process) const;
  /// When its newest start was; nothing if it was never heard.
  [[nodiscard]] std::optional<std::int64_t> epoch_us(const std::string& process) const;
  /// Starts beyond the first, over all processes. A start that ended before its first heartbeat was not seen.
  [[nodiscard]] std::int64_t restarts() const;
  /// Received, rejected and lost summed over every start of every process: what came in twice, at two processes, counts
  /// twice.
  [[nodiscard]] std::map<std::string, MessageCount> messages() const;
  /// Who is not ready and why, in words: "tern-planner: a map; tern-mapper: starting". Empty when all that were heard
  /// are ready.
  [[nodiscard]] std::string waiting() const;

 private:
  struct Process {
    UTime heard;
    std::map<std::int64_t, Heartbeat> starts;  ///< the newest heartbeat by sender epoch
  };
  std::map<std::string, Process> processes_;
};

}  // namespace tern
