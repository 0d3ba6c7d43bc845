// Holds world time back until every process that the flight needs says that it is ready.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/base/time.h"
#include "core/world/health.h"

namespace tern {

/// Listens to heartbeats. A process is ready when its newest heartbeat says Ready and is at most kHeartbeatAge old.
class StartGate {
 public:
  /// Four heartbeats in a row (2 Hz) may be lost before a process counts as gone.
  static constexpr Duration kHeartbeatAge{2'500'000};

  explicit StartGate(std::vector<std::string> needed) : needed_(std::move(needed)) {}

  void hear(const Heartbeat& heartbeat, UTime now);
  [[nodiscard]] bool open(UTime now) const { return missing(now).empty(); }
  /// Who is not ready, and what each is waiting for: "tern-planner (waits for a map), tern-mapper (not heard)". Empty
  /// when everyone is ready.
  [[nodiscard]] std::string missing(UTime now) const;

 private:
  struct Heard {
    UTime at;
    ProcessState state = ProcessState::Starting;
    std::string waiting_for;
  };
  std::vector<std::string> needed_;
  std::map<std::string, Heard> heard_;
};

}  // namespace tern
