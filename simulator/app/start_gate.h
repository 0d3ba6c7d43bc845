// Holds world time back until every required process is ready, with a clock that agrees.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/base/time.h"
#include "core/wire/health.h"
#include "runtime/clock_exchange.h"

namespace tern {

/// Largest allowed difference between a process's clock and the vehicle's, which t_s and deadlines refer to.
///
/// With the executor's default lead, the planner has 66 ms and its optimizer ends at least 14 ms before the deadline.
/// If the planner's clock is 10 ms behind, its answers come 10 ms later, which is still in time. If its clock is 10 ms
/// ahead, it stops 10 ms earlier than it must.
inline constexpr Duration kMaxClockSkew{10'000};

/// A recorded flight waits for this process as well.
inline constexpr const char* kRecorder = "tern-logger";

/// Decides from heartbeats whether the required processes are ready. A process is ready if
/// - its newest heartbeat reports Ready and is at most kHeartbeatAge old,
/// - its clock was compared with the listener's, and
/// - the difference is at most max_skew plus half the round trip, which is the measurement's error.
///
/// So a network delay, symmetric or not, is never taken for skew. An excess over max_skew of less than half the round
/// trip stays undetected.
class StartGate {
 public:
  /// Four consecutive heartbeats (2 Hz) may be lost before a process counts as gone.
  static constexpr Duration kHeartbeatAge{2'500'000};

  /// @param own_epoch_us  the listener's epoch, with which other processes echo its heartbeats
  StartGate(std::vector<std::string> needed, std::int64_t own_epoch_us, Duration max_skew = kMaxClockSkew)
      : needed_(std::move(needed)), own_epoch_us_(own_epoch_us), max_skew_(max_skew) {}

  /// Takes a heartbeat. @param received  receive time, listener's clock
  void receive(const Heartbeat& heartbeat, UTime received);
  [[nodiscard]] bool open(UTime now) const { return missing(now).empty(); }
  /// The processes that are not ready, with reasons: "tern-planner (waits: a map), tern-mapper (no HEARTBEAT)".
  /// Empty when all are ready.
  [[nodiscard]] std::string missing(UTime now) const;
  /// True if tern-logger is ready to record, or if it is not required.
  [[nodiscard]] bool records(UTime now) const;
  /// The required processes whose clock certainly differs by more than max_skew, in the form of missing(). The reason
  /// states the difference and a remedy.
  [[nodiscard]] std::string skewed() const;
  /// The compared clocks of required processes against the listener's: "tern-planner +0.3 ms (round trip 0.2 ms)".
  [[nodiscard]] std::string clocks() const;

 private:
  struct ProcessReport {
    UTime at;
    ProcessState state = ProcessState::Starting;
    std::string waiting_for;
    std::int64_t epoch_us = 0;  ///< a restarted process may have another clock
    ClockSkew skew;
  };
  [[nodiscard]] std::string skew_of(const ProcessReport& report) const;

  std::vector<std::string> needed_;
  std::int64_t own_epoch_us_;
  Duration max_skew_;
  std::map<std::string, ProcessReport> reports_;
};

}  // namespace tern
