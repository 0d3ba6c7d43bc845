// Rules for restarts and for a flight's exit code (docs/reference/exit_codes.md).
#pragma once

#include <string>

#include "core/base/time.h"
#include "monitor/flight_summary.h"
#include "runtime/child_process.h"

namespace tern {

inline constexpr int kExitFailed = 3;       ///< the system failed
inline constexpr int kExitBroken = 4;       ///< the audit found something broken in a flight without a collision
inline constexpr int kExitSignalled = 128;  ///< plus the number of the signal that ended the flight or a process

/// Waiting times before the restarts of one process: 10 ms, doubled with each restart, at most 1 s. After a run of at
/// least 5 s they begin at 10 ms again.
class Backoff {
 public:
  /// Returns the time to wait after the process has ended. @param run  how long it ran, ≥ 0
  Duration next(Duration run);

 private:
  Duration delay_{};
};

/// Whether a restart is useless: exit codes 0 (done), 2 (bad configuration), 3 (network or a process missing), 126 and
/// 127 (not executable).
bool is_permanent(const ProcessEnd& end);

/// The exit code as a shell reports it: 128 + n for signal n.
int shell_code(const ProcessEnd& end);

/// "signal KILL" or "exit code 70".
std::string to_text(const ProcessEnd& end);

/// The flight's exit code from the monitor's: 0 reached, 1 collision, 2 timeout, 3 failed, kExitIncomplete. Without a
/// summary the flight has failed. A full disk is the exception: kExitIncomplete stays.
int code_after_flight(int monitor_code, bool has_summary);

/// The flight's exit code after tern-audit.
/// @param code  before the audit  @param audit_code  0 holds, 1 broken, 3 incomplete, 4 not judged, other: it failed
int code_after_audit(int code, int audit_code);

}  // namespace tern
