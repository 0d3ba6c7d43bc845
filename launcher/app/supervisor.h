// Starts processes, restarts those that die, and ends all of them.
#pragma once

#include <csignal>
#include <optional>
#include <string>
#include <vector>

#include "launcher/flight_processes.h"
#include "launcher/rules.h"
#include "runtime/clock.h"

namespace tern {

/// Blocks SIGCHLD, SIGINT, SIGTERM and SIGHUP, except signals that are ignored, as in background jobs of a shell.
/// Children start with no signal blocked. @return the blocked signals
sigset_t block_signals();

/// The reason why Supervisor::wait returns.
struct SupervisorEvent {
  std::string process;  ///< process that ended and is not restarted; empty: a signal arrived
  int code = 0;         ///< exit code of that process, or 128 + n for signal n
};

/// Starts and restarts processes. Not thread-safe; its process must stay single-threaded.
class Supervisor {
 public:
  /// @param signals  from block_signals
  explicit Supervisor(const sigset_t& signals) : signals_(signals) {}

  /// Starts a process. Its address space is limited to TERN_MEMORY_LIMIT_KB (by default 4 GB; 0: unlimited). A message
  /// that asks for absurd memory then ends the process instead of the machine.
  void start(SupervisedProcess process);
  /// Keeps all processes running until one ends that is not restarted, or a signal arrives. A restart is reported on
  /// the process's standard error.
  SupervisorEvent wait();
  /// Ends tern-mavlink before the others, if it runs. It gets SIGTERM, and goes on until the vehicle is disarmed: it
  /// lands the vehicle, or serves the pilot who flies it. After 2 s this wait is reported on standard error. Then a
  /// further signal ends it at once, and so does the end of kArmedPatience. A vehicle that may be armed is reported,
  /// also if the bridge has crashed and waits for its restart: it is not started again.
  /// @param name  the bridge's process  @param pace  seconds of flight per second of the system's clock
  void end_first(const std::string& name, double pace);
  /// Ends all processes: SIGTERM to all except `last`, then SIGKILL to those left after 1 s. Then the same for `last`,
  /// which records the last messages and gets 5 s. Signals that arrive meanwhile stay pending.
  /// @return how `last` ended; exit code 0 if it was never started
  ProcessEnd stop(const std::string& last);

 private:
  /// A process and its restarts.
  struct Supervised {
    SupervisedProcess process;
    std::optional<pid_t> pid;  ///< while it runs
    ProcessEnd end;            ///< how it ended last
    UTime started;             ///< time of the last start
    std::optional<UTime> due;  ///< time of the next start
    Backoff backoff;
    int restarts = 0;
  };
  void run(Supervised& entry);
  void plan_restart(Supervised& entry, const ProcessEnd& end);
  static bool have_ended(const std::vector<Supervised*>& group);
  static void signal_all(const std::vector<Supervised*>& group, int signal);
  void await_landing(const std::vector<Supervised*>& named, const std::string& name, double pace);
  void end(const std::vector<Supervised*>& group, Duration patience);

  sigset_t signals_;
  WallClock clock_;
  std::vector<Supervised> supervised_;
};

/// Runs a command and restarts it when it dies. SIGTERM, SIGINT and SIGHUP end the command by SIGTERM, and by SIGKILL 1
/// s later. tern-mavlink is ended as by Supervisor::end_first.
/// @param log  file for its output; empty: the output of this process
/// @return the command's exit code if a restart cannot help; 0 after a signal
int keep_alive(const std::vector<std::string>& command, const std::string& log);

}  // namespace tern
