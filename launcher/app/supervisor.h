// Processes that are started, started again when they die, and ended.
#pragma once

#include <csignal>
#include <optional>
#include <string>
#include <vector>

#include "launcher/flight_processes.h"
#include "launcher/rules.h"
#include "runtime/clock.h"

namespace tern {

/// Blocks SIGCHLD, and SIGINT, SIGTERM and SIGHUP but for those that are ignored, as a shell has it for background
/// jobs. Children start with none blocked. @return the blocked ones
sigset_t block_signals();

struct SupervisorEvent {
  std::string process;  ///< which is gone for good; empty: a signal came
  int code = 0;         ///< its exit code, or 128 + n for signal n
};

/// Not thread-safe; its process stays single-threaded.
class Supervisor {
 public:
  /// @param signals  of block_signals
  explicit Supervisor(const sigset_t& signals) : signals_(signals) {}

  /// Each process gets at most TERN_MEMORY_LIMIT_KB of address space (by default 4 GB; 0: no limit). So a message that
  /// asks for absurd memory ends the process, not the machine.
  void start(SupervisedProcess process);
  /// Keeps all running until one is gone for good or a signal comes. Restarts are said on the process's standard error.
  SupervisorEvent wait();
  /// Ends one before the others, if it runs: it may take half a minute of its clock, whose pace this is, to land.
  void end_first(const std::string& name, double pace);
  /// Ends all: SIGTERM to all but `last`, SIGKILL to those that are left after 1 s, then the same to `last`, which
  /// records their last messages, with 5 s. Signals that come meanwhile stay pending.
  void stop(const std::string& last);

 private:
  struct Supervised {
    SupervisedProcess process;
    std::optional<pid_t> pid;  ///< while it runs
    UTime started;             ///< lately
    std::optional<UTime> due;  ///< the next start
    Backoff backoff;
    int restarts = 0;
  };
  void run(Supervised& entry);
  void plan_restart(Supervised& entry, const ProcessEnd& end);
  void end(const std::vector<Supervised*>& group, Duration patience);

  sigset_t signals_;
  WallClock clock_;
  std::vector<Supervised> supervised_;
};

/// Runs a command, and runs it again when it dies. On SIGTERM, SIGINT or SIGHUP the command gets SIGTERM, and SIGKILL 1
/// s later; tern-mavlink has 32 s of its clock before that, to land the vehicle.
/// @param log  file for all that is said; empty: where this process says it
/// @return the command's exit code when another run cannot mend it; 0 after a signal
int keep_alive(const std::vector<std::string>& command, const std::string& log);

}  // namespace tern
