// Every process by its heartbeats: alive, restarted, how many beside each other, what its channels lost.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "core/base/time.h"
#include "core/world/health.h"

namespace tern {

/// Heartbeats come at 2 Hz: a process that was not heard for longer has lost two in a row, or ended.
inline constexpr Duration kHeartbeatTimeout{1'250'000};

/// A channel's messages over all processes that listen to it.
struct MessageCount {
  std::int64_t received = 0;  ///< accepted
  std::int64_t rejected = 0;  ///< refused, whatever the reason
  std::int64_t lost = 0;      ///< gaps in sequence numbers
};

/// Keeps the newest heartbeat of each start (sender epoch) of each process, so that the counts of one that died are
/// kept. A start that was heard once and not again within kHeartbeatTimeout is noise: it is forgotten, and counts
/// nowhere.
class ProcessTable {
 public:
  /// @param now  the listener's clock, as everywhere here
  void add(const Heartbeat& heartbeat, UTime now);

  /// The start of a process that counts: the one that was heard first, until it has been silent for kHeartbeatTimeout.
  /// 0: it was never heard.
  [[nodiscard]] std::int64_t epoch_us(const std::string& process) const;
  /// @return when a start of a process was heard last, or nullopt if never.
  [[nodiscard]] std::optional<UTime> heard(const std::string& process, std::int64_t epoch_us) const;
  /// Starts beyond the first, over all processes. A start that ended before its second heartbeat was not seen; one that
  /// was heard while an earlier one lived is no restart.
  [[nodiscard]] std::int64_t restarts() const;
  /// Processes of which more than one lived at a time, and how many at most.
  [[nodiscard]] const std::map<std::string, int>& beside() const { return beside_; }
  /// "2 tern-predictor, 3 tern-mapper": those of which more than one live now; empty when there is none.
  [[nodiscard]] std::string concurrent_now(UTime now) const;
  /// Received, rejected and lost summed over every start of every process: what came in twice, at two processes, counts
  /// twice.
  [[nodiscard]] std::map<std::string, MessageCount> messages() const;
  /// Who is not ready and why, in words: "tern-planner: a map; tern-mapper: starting". Empty when all that were heard
  /// are ready.
  [[nodiscard]] std::string waiting() const;

 private:
  struct Start {
    Heartbeat newest;
    UTime first_heard, heard;
    std::int64_t beats = 0;
  };
  struct Process {
    std::map<std::int64_t, Start> starts;  ///< by sender epoch; never empty
    std::int64_t counts = 0;               ///< the epoch of the start that counts
  };
  void forget_noise(UTime now);
  [[nodiscard]] static int living(const Process& process, UTime now);
  [[nodiscard]] static std::int64_t restarts_of(const Process& process);

  std::map<std::string, Process> processes_;
  std::map<std::string, int> beside_;
};

}  // namespace tern
