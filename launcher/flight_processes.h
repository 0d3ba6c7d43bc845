// Which processes a flight has, and with which options.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "runtime/child_process.h"

namespace tern {

struct LaunchOptions {
  std::string programs;                ///< the folder of Tern's programs
  std::string scenario;                ///< file
  std::vector<std::string> overrides;  ///< of the scenario's values, KEY=VALUE
  std::string lcm_url;
  double pace = 1.0;                   ///< seconds of flight per second of the system's clock, (0, 1]
  std::string namespace_flags;         ///< of unshare(1), by which the flight's network was made; empty: the host's
  std::string record;                  ///< folder for log, process logs and summary; empty: a new one in `flights`
  std::string flights;                 ///< folder of records
  std::string summary;                 ///< file to which the summary goes, too; empty: none
  std::string command;                 ///< the command that the user typed, for the record
  std::optional<std::string> key;      ///< sign messages, with the master key of this file; empty: with a new one
  std::optional<int> view_fd;          ///< a listening socket for tern-viewer; none: no viewer
  int view_wait_s = 30;                ///< the flight waits so long for the first page that looks, s, ≥ 0
  std::optional<int> looked_fd;        ///< where tern-viewer says that one does
  std::optional<int> listens_fd;       ///< where tern-logger says that it misses nothing from now on
  std::string view_url, page;          ///< that socket's URL; the folder of the built page
  bool allow_goals = false;            ///< the page may send goals
  std::string autopilot;               ///< where tern-mavlink connects to; empty: the simulator flies its own vehicle
  bool default_dynamics = false;       ///< the scenario states no uav.dynamics, and an autopilot flies
  bool autopilot_sim = false;          ///< the autopilot there is tern-autopilot-sim; needs udp://
  bool audit = false, report = false;  ///< look back when it has ended
};

struct SupervisedProcess {
  std::string name;  ///< "tern-planner"
  ChildProcess child;
  bool restarted = true;  ///< when it dies, unless that cannot help (is_permanent)
};

/// What an autopilot with PX4's default bounds (45°, 220°/s) and thrust/weight 2 can fly, less what it needs to
/// correct.
inline constexpr char kAutopilotDynamics[] =
    "uav.dynamics={thrust_min: 4, thrust_max: 16, tilt_max: 38, body_rate_max: 170}";
inline constexpr char kMavlink[] = "tern-mavlink", kAutopilotSim[] = "tern-autopilot-sim";
inline constexpr char kLogger[] = "tern-logger", kMonitor[] = "tern-monitor", kViewer[] = "tern-viewer";

/// The processes of a flight in the order of their start. First comes the viewer, whose page is waited for, then logger
/// and monitor, so that they miss nothing. All are restarted but the monitor, whose judgement rests on all that it
/// heard.
/// @param record  the flight's folder  @param key_fds  by process, an open file of its keys; empty: unsigned
std::vector<SupervisedProcess> flight_processes(const LaunchOptions& options, const std::string& record,
                                                const std::map<std::string, int>& key_fds);

/// What asks each program that this flight does without to check its section of the scenario: a misspelt key is a
/// mistake of the file, whoever flies. Each command ends with 0, or says on standard error what it refuses.
std::vector<std::vector<std::string>> checks_of_unused_sections(const LaunchOptions& options,
                                                                const std::vector<SupervisedProcess>& processes);

/// Words as a line that a shell reads back as these words.
std::string shell_line(const std::vector<std::string>& words);

}  // namespace tern
