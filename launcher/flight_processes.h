// The processes of a flight and their options.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/world/vehicle.h"
#include "runtime/child_process.h"

namespace tern {

struct LaunchOptions {
  std::string programs;                ///< folder of Tern's programs
  std::string scenario;                ///< its file
  std::vector<std::string> overrides;  ///< overrides of the scenario's values, KEY=VALUE
  std::string lcm_url;
  double pace = 1.0;               ///< seconds of flight per second of the system's clock, (0, 1]
  std::string namespace_flags;     ///< flags of unshare(1) that made the flight's network; empty: the host's network
  std::string record;              ///< folder for log, process logs and summary; empty: a new one in `flights`
  std::string flights;             ///< folder for new flights
  std::string summary;             ///< file that gets a copy of the summary; empty: none
  std::string command;             ///< command line of the user, for the record
  std::optional<std::string> key;  ///< sign messages with the master key of this file; empty: with a new key
  std::optional<int> view_fd;      ///< a listening socket for tern-viewer; none: no viewer
  int view_wait_s = 30;            ///< the flight waits this long for the first page to connect, s, ≥ 0
  std::optional<int> looked_fd;    ///< tern-viewer writes a byte there when a page has connected
  std::optional<int> listens_fd;   ///< tern-logger writes a byte there when it records every message
  std::string view_url, page;      ///< URL of that socket; folder of the built page
  bool allow_goals = false;        ///< pages may send goals
  std::string autopilot;           ///< address for tern-mavlink; empty: the simulator flies its own vehicle
  std::string odometry;            ///< with `autopilot`: address of another estimator; empty: none
  std::vector<std::string> autopilot_limits;  ///< overrides for a flight with an autopilot
  bool autopilot_sim = false;                 ///< the autopilot is tern-autopilot-sim; needs udp://
  bool detects = false;                       ///< tern-detector runs as well (section detector)
  bool estimates = false;                     ///< tern-estimator flies as well (simulator.estimation: vio)
  std::string mission;                 ///< for tern-mission: a file, or a MAVLink URL; empty: the scenario's goal
  bool audit = false, report = false;  ///< run tern-audit, tern-report after the flight
};

/// A process that the launcher starts.
struct SupervisedProcess {
  std::string name;  ///< "tern-planner"
  ChildProcess child;
  bool restarted = true;  ///< start it again when it dies, unless is_permanent
};

/// Returns overrides that fit an autopilot with PX4's default bounds and thrust/weight 2, with a reserve for feedback.
/// The bounds are 45°, 220°/s, 12 m/s level and 1.5 m/s down. Limits with `dynamics` are a vehicle's own and are
/// kept. If the autopilot certainly has the default bounds (a simulated one), v_max is lowered to them all the same.
std::vector<std::string> autopilot_limits(const Limits& limits, bool has_defaults);
inline constexpr char kMavlink[] = "tern-mavlink", kAutopilotSim[] = "tern-autopilot-sim";
inline constexpr char kDetector[] = "tern-detector", kEstimator[] = "tern-estimator";
inline constexpr char kMission[] = "tern-mission";
inline constexpr char kLogger[] = "tern-logger", kMonitor[] = "tern-monitor", kViewer[] = "tern-viewer";

/// The processes of a flight in the order of their start. The viewer is first, because the flight waits for its page.
/// Logger and monitor follow, so that they receive everything. Two are not restarted: the monitor, whose judgement
/// needs all messages of the flight, and tern-autopilot-sim.
/// @param record  the flight's folder
/// @param key_fds  by process, an open file with its keys; empty: messages are unsigned
std::vector<SupervisedProcess> flight_processes(const LaunchOptions& options, const std::string& record,
                                                const std::map<std::string, int>& key_fds);

/// Returns commands that check the scenario's sections of processes that do not fly. So a misspelt key is found in
/// every flight. An absent section gets no command, and its program may be unbuilt. A command ends with 0, or prints
/// its refusal on standard error.
/// @param sections  the scenario's keys, overrides included
std::vector<std::vector<std::string>> checks_of_unused_sections(const LaunchOptions& options,
                                                                const std::vector<SupervisedProcess>& processes,
                                                                const std::vector<std::string>& sections);

/// Joins words to a line that a shell reads as these words.
std::string shell_line(const std::vector<std::string>& words);

}  // namespace tern
