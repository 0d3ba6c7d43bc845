// Tracks every process by its heartbeats: restarts, several at a time, lost messages.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "core/base/time.h"
#include "core/wire/health.h"

namespace tern {

/// Heartbeats come at 2 Hz: a process that is silent for longer has ended, or two heartbeats in a row were lost.
inline constexpr Duration kHeartbeatTimeout{1'250'000};

/// A channel's messages, summed over all processes that receive it.
struct MessageCount {
  std::int64_t received = 0;  ///< accepted
  std::int64_t rejected = 0;  ///< refused for any reason
  std::int64_t lost = 0;      ///< gaps in sequence numbers
};

/// Keeps the newest heartbeat of each start (sender epoch) of each process, so the counts of ended processes stay. A
/// start with a single heartbeat and none within kHeartbeatTimeout after it is noise: it is forgotten and counted
/// nowhere.
class ProcessTable {
 public:
  /// @param now  the listener's clock, as in all functions here
  void add(const Heartbeat& heartbeat, UTime now);

  /// The epoch of the active start of a process. The first start received is active. Once it is silent for
  /// kHeartbeatTimeout, the next start with two heartbeats takes its place. 0 if there was none.
  [[nodiscard]] std::int64_t epoch_us(const std::string& process) const;
  /// @return when the last heartbeat of that start arrived, or nullopt if there was none.
  [[nodiscard]] std::optional<UTime> last_heartbeat(const std::string& process, std::int64_t epoch_us) const;
  /// Number of starts beyond the first, summed over all processes. Starts that end before their second heartbeat are
  /// not seen. A start that overlaps an earlier one is not a restart.
  [[nodiscard]] std::int64_t restarts() const;
  /// Processes of which several ran at a time, with the largest number.
  [[nodiscard]] const std::map<std::string, int>& concurrent() const { return concurrent_; }
  /// "2 tern-predictor, 3 tern-mapper": processes of which several run at `now`; may be empty.
  [[nodiscard]] std::string concurrent_now(UTime now) const;
  /// Received, rejected and lost messages, summed over every start of every process. A message that two processes
  /// received counts twice.
  [[nodiscard]] std::map<std::string, MessageCount> messages() const;
  /// The processes that are not ready, with reasons: "tern-planner: a map; tern-mapper: starting". Empty if all are
  /// ready.
  [[nodiscard]] std::string waiting() const;
  /// The warnings of processes that are ready or have finished, by name: the text of their newest heartbeat. Processes
  /// without one are left out.
  [[nodiscard]] std::map<std::string, std::string> words() const;

 private:
  struct Start {
    Heartbeat newest;
    std::string words;  ///< of the newest one in state Ready
    UTime first_heartbeat, last_heartbeat;
    std::int64_t beats = 0;
  };
  struct Process {
    std::map<std::int64_t, Start> starts;  ///< by sender epoch; never empty
    std::int64_t active_epoch_us = 0;      ///< epoch of the active start
  };
  void forget_noise(UTime now);
  [[nodiscard]] static int living(const Process& process, UTime now);
  [[nodiscard]] static std::int64_t restarts_of(const Process& process);

  std::map<std::string, Process> processes_;
  std::map<std::string, int> concurrent_;
};

}  // namespace tern
