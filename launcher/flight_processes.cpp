#include "launcher/flight_processes.h"

#include <algorithm>

namespace tern {

std::vector<SupervisedProcess> flight_processes(const FlightOptions& options, const std::string& record,
                                                const std::map<std::string, int>& key_fds) {
  std::vector<SupervisedProcess> processes;
  const auto add = [&](const std::string& name, const std::vector<std::string>& more) -> SupervisedProcess& {
    SupervisedProcess& process = processes.emplace_back();
    process.name = name;
    auto& words = process.child.command = {options.programs + "/" + name, "--config", options.scenario};
    for (const std::string& value : options.overrides) words.insert(words.end(), {"--set", value});
    words.insert(words.end(), {"--lcm-url", options.lcm_url});
    if (const auto key = key_fds.find(name); key != key_fds.end()) {
      words.insert(words.end(), {"--key-fd", std::to_string(key->second)});
      process.child.inherited.push_back(key->second);
    }
    words.insert(words.end(), more.begin(), more.end());
    return process;
  };
  const std::string log = record + "/flight.lcm";
  add(kLogger, {"--record", log});
  add(kMonitor, {"--summary", record + "/summary.json", "--log", log, "--failure-file", record + "/failure",
                 "--command", options.typed})
      .restarted = false;
  if (options.view_fd) {
    ChildProcess& viewer = add("tern-viewer", {"--page", options.page}).child;
    viewer.inherited.push_back(*options.view_fd);
    if (options.allow_goals) viewer.command.emplace_back("--allow-goals");
  }
  for (const char* name : {"tern-simulator", "tern-executor", "tern-predictor", "tern-mapper", "tern-planner"})
    add(name, {});
  const auto simulator = std::find_if(processes.begin(), processes.end(),
                                      [](const SupervisedProcess& p) { return p.name == "tern-simulator"; });
  simulator->child.command.emplace_back("--recorded");
  return processes;
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
