// When a process is started again, and how a flight's exit code comes about.
#pragma once

#include <string>

#include "core/base/time.h"
#include "runtime/child_process.h"

namespace tern {

inline constexpr int kExitFailed = 3;       ///< the system itself failed
inline constexpr int kExitBroken = 4;       ///< the audit found something broken, in a flight that did not collide
inline constexpr int kExitSignalled = 128;  ///< plus the number of the signal that ended the flight, or a process

/// Waiting times before the restarts of one process: 10 ms, doubled by each restart, at most 1 s. After a run of 5 s or
/// more they begin anew.
class Backoff {
 public:
  /// The time to wait now that the process has ended. @param run  how long it ran, ≥ 0
  Duration next(Duration run);

 private:
  Duration delay_{};
};

/// Whether another run cannot mend it: exit codes 0 (done), 2 (bad configuration), 3 (no network, nobody ready), 126
/// and 127 (cannot be run).
bool is_permanent(const ProcessEnd& end);

/// As a shell tells it: 128 + n for signal n.
int shell_code(const ProcessEnd& end);

/// "signal KILL", "exit code 70".
std::string to_text(const ProcessEnd& end);

/// The flight's exit code by the monitor's: 0 reached, 1 collision, 2 not reached in time, 3 failed. Without a summary
/// the monitor's code is no judgement.
int code_after_flight(int monitor_code, bool has_summary);

/// The flight's exit code after tern-audit. @param code  before, 0 … 3  @param audit_code  0 held, 1 broken, else
/// failed
int code_after_audit(int code, int audit_code);

}  // namespace tern
