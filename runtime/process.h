// What every Tern process has in common: command line, scenario, bus, heartbeat, signals, exit codes.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "core/world/scenario.h"
#include "runtime/bus.h"
#include "runtime/clock_exchange.h"
#include "runtime/config.h"
#include "runtime/node.h"

namespace CLI {
class App;
}

namespace tern {

inline constexpr int kExitBadConfiguration = 2;  ///< bad command line, configuration or scenario; nothing was published
inline constexpr int kExitNoNetwork = 3;         ///< LCM cannot be used
inline constexpr int kExitStuck = 70;            ///< stuck, or an internal error (in the log): restart me

/// What a process is given to build its node.
struct ProcessContext {
  const Scenario& scenario;
  ConfigSection section;  ///< this process's own section of the scenario file; the node calls finish()
  Bus& bus;
  /// The document of both: for a process that hosts another's part (the simulator reads `executor` too). When all
  /// sections have been read, configuration_hash(document.effective()) names the configuration.
  ConfigDocument& document;
};

/// The text that CONFIGURATION carries: the effective configuration, or its head. Then a last line says how much was
/// cut and the digest of the whole, so that texts differ when configurations do.
std::string reported_yaml(const std::string& effective_yaml);

/// The hash that CONFIGURATION carries, and PLAN as its configuration_hash: digest(reported_yaml(effective_yaml)).
std::uint64_t configuration_hash(const std::string& effective_yaml);

struct ProcessDescription {
  std::string name;                                 ///< "tern-planner"
  std::string section;                              ///< "planner": its key in the scenario file; "" if it has none
  std::string summary;                              ///< one line for --help
  std::function<void(CLI::App&)> add_options = {};  ///< options besides the common ones
  /// Reads its section, for --help-config and --check-config. Empty: it has none.
  std::function<void(ConfigSection)> read_section = {};
  std::string example = {};  ///< a scenario that makes every key known, where some depend on another
};

using NodeFactory = std::function<std::unique_ptr<Node>(ProcessContext&)>;

/// A sender's epoch, µs: at most 2048 µs before now. Of processes that start in the same microsecond one would be taken
/// for the other, so the last ten bits are the process id's. Who starts 2048 µs later has the larger one.
/// @pre process_id ≥ 0
std::int64_t unique_epoch(std::int64_t now_us, std::int64_t process_id);

/// Parses --help, --help-config, --check-config, --version, --config FILE, --set KEY=VALUE …, --lcm-url URL,
/// --clock-offset-us N,
/// --pace P, --channel-suffix S, --log-level L, --key-file FILE, --key-fd N. Loads the scenario (without --config: all
/// defaults) and makes the node. Publishes CONFIGURATION (at start, then every 5 s) and HEARTBEAT (2 Hz). Runs until
/// the node has finished, or SIGINT/SIGTERM (exit 0). Logs to stderr. The epoch is unique_epoch of the wall clock's
/// time at the start, without the offset.
/// @return the exit code: the node's own, 0 after a signal, or kExit…. ConfigError and bad options: the message on
/// stderr, exit 2. A node that finishes with kExitStuck ends the process here and now, nothing is destroyed: one of its
/// threads may never end.
int run_process(int argc, char** argv, const ProcessDescription& description, const NodeFactory& make_node);

/// A clock that the system's has left by more is said on HEARTBEAT and in the log.
inline constexpr Duration kReportedDrift{10'000};

/// Heartbeats that answer a new process leave at least this far apart, whoever comes.
inline constexpr Duration kHeartbeatSpacing{50'000};

/// Hosts one node: its heartbeat and configuration reports, its pacing. The same in a process and in virtual time.
///
/// A heartbeat echoes the newest ones heard of others. One of a process that was not heard lately is answered at once.
/// So both can compare their clocks a round trip after the later one has started. While tern-logger says that it waits,
/// CONFIGURATION is repeated with its heartbeats.
class NodeHost {
 public:
  /// @param effective_yaml  reported on CONFIGURATION, by reported_yaml
  NodeHost(Bus& bus, Node& node, std::string process, const std::string& effective_yaml);
  /// The earliest of the node's wakeup, the reports, and paced messages.
  [[nodiscard]] UTime next_wakeup() const;
  /// Whether step(now) has something to do: a wakeup has come, or messages were delivered since the last step.
  [[nodiscard]] bool is_due(UTime now) const;
  /// Steps the node if is_due for its sake, then sends what is due. A node that has just finished says so on HEARTBEAT
  /// at once.
  void step(UTime now);
  [[nodiscard]] const Node& node() const { return node_; }
  [[nodiscard]] const std::string& process() const { return process_; }
  [[nodiscard]] Bus& bus() const { return bus_; }

 private:
  void on_heartbeat(const Heartbeat& heartbeat);
  void publish_heartbeat();
  void publish_configuration();
  std::string report_drift();
  Bus& bus_;
  Node& node_;
  std::string process_, yaml_;
  ClockEchoes heard_;
  UTime last_heartbeat_{}, next_heartbeat_{}, next_configuration_{};
  std::int64_t stepped_deliveries_ = 0;
  bool reported_finished_ = false;
  Duration reported_drift_{};
};

}  // namespace tern
