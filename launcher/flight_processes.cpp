#include "launcher/flight_processes.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace tern {
namespace {

/// Whether missions come over MAVLink instead of from a file.
bool is_uploaded(const LaunchOptions& options) { return options.mission.find("://") != std::string::npos; }

/// Overrides for a flight with an autopilot, then those of the user, which take precedence.
std::vector<std::string> overrides_of(const LaunchOptions& options) {
  std::vector<std::string> values;
  if (!options.autopilot.empty()) {
    values = {"simulator.vehicle=external", "simulator.wait_s=180", "mavlink.start=arm",
              "simulator.wait_for=tern-mavlink, tern-executor, tern-predictor, tern-mapper, tern-planner"};
  }
  values.insert(values.end(), options.autopilot_limits.begin(), options.autopilot_limits.end());
  if (options.autopilot_sim) {
    values.insert(values.end(), {"mavlink.set_parameters=true", "mavlink.without_remote=true"});
  }
  if (!options.mission.empty()) {
    values.push_back(std::string("simulator.goals_from=") + kMission);
    values.push_back(is_uploaded(options) ? "mission.fence_uploads=true" : "mission.file=" + options.mission);
  }
  values.insert(values.end(), options.overrides.begin(), options.overrides.end());
  return values;
}

void pass(std::optional<int> fd, const char* option, ChildProcess& child) {
  if (!fd) return;
  child.inherited.push_back(*fd);
  child.command.insert(child.command.end(), {option, std::to_string(*fd)});
}

}  // namespace

std::vector<std::string> autopilot_limits(const Limits& limits, bool has_defaults) {
  constexpr double kLevel = 12.0, kDown = 1.5;  // MPC_XY_VEL_MAX, MPC_Z_VEL_MAX_DN
  if (limits.dynamics && !has_defaults) return {};
  std::vector<std::string> values;
  if (!limits.dynamics) {
    values.emplace_back("uav.dynamics={thrust_min: 4, thrust_max: 16, tilt_max: 38, body_rate_max: 170}");
  }
  Vec3 v = limits.v_max;
  v.head<2>() *= std::min(1.0, kLevel / v.head<2>().norm());
  v.z() = std::min(v.z(), kDown);
  if (v != limits.v_max) values.push_back(fmt::format("uav.limits.v_max=[{}, {}, {}]", v.x(), v.y(), v.z()));
  return values;
}

std::vector<SupervisedProcess> flight_processes(const LaunchOptions& options, const std::string& record,
                                                const std::map<std::string, int>& key_fds) {
  std::vector<SupervisedProcess> processes;
  const std::vector<std::string> overrides = overrides_of(options);
  const auto add = [&](const std::string& name, const std::vector<std::string>& more) -> SupervisedProcess& {
    SupervisedProcess& process = processes.emplace_back();
    process.name = name;
    auto& words = process.child.command = {options.programs + "/" + name, "--config", options.scenario};
    for (const std::string& value : overrides) words.insert(words.end(), {"--set", value});
    words.insert(words.end(), {"--lcm-url", options.lcm_url});
    words.insert(words.end(), {"--pace", fmt::format("{}", options.pace)});
    if (const auto key = key_fds.find(name); key != key_fds.end()) {
      words.insert(words.end(), {"--key-fd", std::to_string(key->second)});
      process.child.inherited.push_back(key->second);
    }
    words.insert(words.end(), more.begin(), more.end());
    return process;
  };
  if (options.view_fd) {
    ChildProcess& viewer = add(kViewer, {"--page", options.page}).child;
    viewer.inherited.push_back(*options.view_fd);
    if (options.allow_goals) viewer.command.emplace_back("--allow-goals");
    pass(options.looked_fd, "--looked-fd", viewer);
  }
  const std::string log = record + "/flight.lcm";
  pass(options.listens_fd, "--listens-fd", add(kLogger, {"--record", log}).child);
  add(kMonitor, {"--summary", record + "/summary.json", "--log", log, "--failure-file", record + "/failure",
                 "--command", options.command})
      .restarted = false;
  for (const char* name : {"tern-simulator", "tern-executor", "tern-predictor", "tern-mapper", "tern-planner"})
    add(name, {});
  if (options.detects) add(kDetector, {});
  if (options.estimates) add(kEstimator, {});
  if (!options.mission.empty()) {
    std::vector<std::string>& words = add(kMission, {"--record", record}).child.command;
    if (is_uploaded(options)) words.insert(words.end(), {"--connect", options.mission});
  }
  if (!options.autopilot.empty()) {
    std::vector<std::string>& words = add(kMavlink, {"--connect", options.autopilot}).child.command;
    if (!options.odometry.empty()) words.insert(words.end(), {"--odometry", options.odometry});
  }
  if (options.autopilot_sim) {
    const std::string place = options.autopilot.substr(options.autopilot.find("//"));
    add(kAutopilotSim, {"--connect", "udpout:" + place}).restarted = false;
  }
  const auto simulator = std::find_if(processes.begin(), processes.end(),
                                      [](const SupervisedProcess& p) { return p.name == "tern-simulator"; });
  simulator->child.command.emplace_back("--recorded");
  return processes;
}

std::vector<std::vector<std::string>> checks_of_unused_sections(const LaunchOptions& options,
                                                                const std::vector<SupervisedProcess>& processes,
                                                                const std::vector<std::string>& sections) {
  std::vector<std::vector<std::string>> checks;
  for (const auto& [name, section] : std::initializer_list<std::pair<const char*, const char*>>{
           {kEstimator, "estimator"}, {kMavlink, "mavlink"}, {kAutopilotSim, "autopilot_sim"}, {kMission, "mission"}}) {
    const auto flies = [name = name](const SupervisedProcess& p) { return p.name == name; };
    if (std::any_of(processes.begin(), processes.end(), flies)) continue;
    if (std::find(sections.begin(), sections.end(), section) == sections.end()) continue;
    auto& words = checks.emplace_back();
    words = {options.programs + "/" + name, "--check-config", "--config", options.scenario};
    for (const std::string& value : options.overrides) words.insert(words.end(), {"--set", value});
  }
  return checks;
}

std::string shell_line(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) {
    line += line.empty() ? "'" : " '";
    for (const char c : word) line += c == '\'' ? std::string("'\\''") : std::string(1, c);
    line += '\'';
  }
  return line;
}

}  // namespace tern
