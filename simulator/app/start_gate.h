// Holds world time back until every process that the flight needs says that it is ready, by a clock that agrees.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/base/time.h"
#include "core/world/health.h"
#include "runtime/clock_exchange.h"

namespace tern {

/// What a clock may be away from the vehicle's, in which t_s and deadlines are. With the executor's default lead the
/// optimizer ends 14 ms before the deadline at the latest. So a clock 10 ms behind still answers in time. One 10 ms
/// ahead takes as much from the 66 ms that the planner has.
inline constexpr Duration kMaxClockSkew{10'000};

/// Whom a flight that is recorded waits for, too.
inline constexpr const char* kRecorder = "tern-logger";

/// Listens to heartbeats. A process is ready when its newest heartbeat says Ready and is at most kHeartbeatAge old, and
/// its clock was compared with the listener's. The clock must not be off by more than max_skew and half the round trip,
/// by which a measurement may err. So no delay of the network, alike both ways or not, is taken for skew. But a skew
/// below half the round trip is not seen.
class StartGate {
 public:
  /// Four heartbeats in a row (2 Hz) may be lost before a process counts as gone.
  static constexpr Duration kHeartbeatAge{2'500'000};

  /// @param own_epoch_us  the listener's, by which others tell its heartbeats back
  StartGate(std::vector<std::string> needed, std::int64_t own_epoch_us, Duration max_skew = kMaxClockSkew)
      : needed_(std::move(needed)), own_epoch_us_(own_epoch_us), max_skew_(max_skew) {}

  /// @param received  when the network delivered it, the listener's clock
  void receive(const Heartbeat& heartbeat, UTime received);
  [[nodiscard]] bool open(UTime now) const { return missing(now).empty(); }
  /// Who is not ready, and what each is waiting for: "tern-planner (waits for a map), tern-mapper (not heard)". Empty
  /// when everyone is ready.
  [[nodiscard]] std::string missing(UTime now) const;
  /// Whether the log, if one is waited for, will hold what is published from now on.
  [[nodiscard]] bool records(UTime now) const;
  /// Whose clock is surely beyond max_skew, by how much, and what to do, in the same form. Empty when nobody's is.
  [[nodiscard]] std::string skewed() const;
  /// "tern-planner +0.3 ms (round trip 0.2 ms), tern-mapper -0.1 ms (round trip 0.1 ms)": the needed ones' clocks that
  /// were compared, against the listener's.
  [[nodiscard]] std::string clocks() const;

 private:
  struct ProcessReport {
    UTime at;
    ProcessState state = ProcessState::Starting;
    std::string waiting_for;
    std::int64_t epoch_us = 0;  ///< a process that was started anew may run by another clock
    ClockSkew skew;
  };
  [[nodiscard]] std::string skew_of(const ProcessReport& heard) const;

  std::vector<std::string> needed_;
  std::int64_t own_epoch_us_;
  Duration max_skew_;
  std::map<std::string, ProcessReport> reports_;
};

}  // namespace tern
