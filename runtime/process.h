// What every Tern process has in common: command line, scenario, bus, heartbeat, signals, exit codes.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/world/scenario.h"
#include "runtime/bus.h"
#include "runtime/config.h"
#include "runtime/node.h"

namespace CLI {
class App;
}

namespace tern {

inline constexpr int kExitBadConfiguration = 2;   ///< nothing was published
inline constexpr int kExitStuck = 70;             ///< the planner's worker missed two deadlines: restart me

/// What a process is given to build its node.
struct ProcessContext {
  const Scenario& scenario;
  ConfigSection section;    ///< this process's own section of the scenario file; the node calls finish()
  Bus& bus;
};

struct ProcessDescription {
  std::string name;         ///< "tern-planner"
  std::string section;      ///< "planner": its key in the scenario file; "" if it has none
  std::string summary;      ///< one line for --help
  std::function<void(CLI::App&)> add_options = {};  ///< options besides the common ones
};

using NodeFactory = std::function<std::unique_ptr<Node>(ProcessContext&)>;

/// Parses --help, --version, --config FILE, --set KEY=VALUE …, --lcm-url URL, --clock-offset-us N, --channel-suffix S, --log-level L;
/// loads the scenario, makes the node, publishes CONFIGURATION (at start, then every 5 s) and HEARTBEAT (2 Hz), and runs until the node
/// has finished, or SIGINT/SIGTERM (exit 0). ConfigError: the message on stderr, exit 2. LCM not usable: exit 3.
int run_process(int argc, char** argv, const ProcessDescription& description, const NodeFactory& make_node);

/// Hosts one node: its heartbeat and configuration reports, its pacing. The same in a process and in virtual time.
class NodeHost {
 public:
  NodeHost(Bus& bus, Node& node, std::string process, std::string effective_yaml);
  [[nodiscard]] UTime next_wakeup() const;
  void step(UTime now);

 private:
  void publish_heartbeat();
  Bus& bus_;
  Node& node_;
  std::string process_, yaml_;
  UTime next_heartbeat_{}, next_configuration_{};
};

}  // namespace tern
