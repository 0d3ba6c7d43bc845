// The parts that all Tern processes share: command line, scenario, bus, heartbeat, signals, exit codes.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "core/scenario/scenario.h"
#include "runtime/bus.h"
#include "runtime/clock_exchange.h"
#include "runtime/command_line.h"
#include "runtime/config.h"
#include "runtime/node.h"

namespace tern {

inline constexpr int kExitBadConfiguration = 2;  ///< bad command line, configuration or scenario; no message was sent
inline constexpr int kExitNoNetwork = 3;         ///< LCM cannot be used
inline constexpr int kExitStuck = 70;            ///< stuck or an internal error (see the log); should be restarted

/// The arguments from which a process builds its node.
struct ProcessContext {
  const Scenario& scenario;
  ConfigSection section;  ///< this process's section of the scenario file; the node calls finish()
  Bus& bus;
  /// The document that contains the scenario and all sections. A process that includes a part of another one reads that
  /// section from it (the simulator reads `executor`). After all sections have been read,
  /// configuration_hash(document.effective()) identifies the configuration.
  ConfigDocument& document;
};

/// The text for CONFIGURATION: the effective configuration, or its head if it is too long. In that case a last line
/// states the lengths and the digest of the whole, so that different configurations have different texts.
std::string reported_yaml(const std::string& effective_yaml);

/// The hash for CONFIGURATION, and for PLAN's configuration_hash: digest(reported_yaml(effective_yaml)).
std::uint64_t configuration_hash(const std::string& effective_yaml);

/// The fixed properties of a process, for run_process().
struct ProcessDescription {
  std::string name;     ///< "tern-planner"
  std::string section;  ///< "planner": its section of the scenario file; "" if it has none
  std::string summary;  ///< one line for --help
  std::function<void(CommandLine&)> add_options = {};  ///< adds options to the common ones
  /// Reads its section, for --help-config and --check-config. Empty if it has none.
  std::function<void(ConfigSection)> read_section = {};
  std::string example = {};  ///< a scenario for --help-config, if some keys depend on others
};

using NodeFactory = std::function<std::unique_ptr<Node>(ProcessContext&)>;

/// A sender's epoch, µs: at most 2048 µs before now. Its last ten bits are the process id's, so processes that start in
/// the same microsecond differ. A process that starts 2048 µs later has a larger epoch.
/// @pre process_id ≥ 0
std::int64_t unique_epoch(std::int64_t now_us, std::int64_t process_id);

/// Runs a process from its command line to its end:
///  1. Parses the common options (docs/reference/programs.md).
///  2. Loads the scenario (all defaults without --config) and makes the node. The epoch is unique_epoch() of the wall
///     clock's time at the start, without the offset.
///  3. Publishes CONFIGURATION (at start, then every 5 s) and HEARTBEAT (2 Hz). Logs to stderr.
///  4. Runs until the node has finished, or until SIGINT or SIGTERM.
///
/// @return the node's exit code, 0 after a signal, or kExit…. A ConfigError and bad options print a message on stderr
///   and return 2. If the node finishes with kExitStuck, the process exits immediately without destructors, because one
///   of its threads may never end.
int run_process(int argc, char** argv, const ProcessDescription& description, const NodeFactory& make_node);

/// If the system's clock has been set by more than this, the drift is reported on HEARTBEAT and in the log.
inline constexpr Duration kReportedDrift{10'000};

/// If a node has been waiting for this long, the log says once for what.
inline constexpr Duration kLongWait{5'000'000};

/// Least time between heartbeats that answer new processes.
inline constexpr Duration kHeartbeatSpacing{50'000};

/// Hosts one node: its heartbeat, its configuration reports, its paced sending. The same in a process and in virtual
/// time.
///
/// A heartbeat echoes the newest heartbeats of other processes. The first heartbeat of a process is answered
/// immediately, so both can compare their clocks one round trip after the later one has started. While tern-logger
/// reports that it is waiting, CONFIGURATION is repeated with each of its heartbeats.
class NodeHost {
 public:
  /// @param effective_yaml  published on CONFIGURATION, through reported_yaml, with the node's notes below
  NodeHost(Bus& bus, Node& node, std::string process, const std::string& effective_yaml);
  /// The earliest of the node's wakeup, the next report and the next paced message.
  [[nodiscard]] UTime next_wakeup() const;
  /// Whether step(now) has something to do: a wakeup has come, or messages were delivered since the last step.
  [[nodiscard]] bool is_due(UTime now) const;
  /// Steps the node if its wakeup has come or messages were delivered; then sends the due reports and paced messages. A
  /// node that has just finished reports it immediately on HEARTBEAT.
  void step(UTime now);
  /// Asks the node to end, for a signal. @return whether it ends now
  [[nodiscard]] bool end(UTime now) { return node_.end(now); }
  [[nodiscard]] const Node& node() const { return node_; }
  [[nodiscard]] const std::string& process() const { return process_; }
  [[nodiscard]] Bus& bus() const { return bus_; }

 private:
  void on_heartbeat(const Heartbeat& heartbeat);
  void publish_heartbeat();
  void publish_configuration();
  std::string report_drift();
  void log_long_wait(const NodeHealth& health);
  Bus& bus_;
  Node& node_;
  std::string process_, yaml_;
  ClockEchoes echoes_;
  UTime last_heartbeat_{}, next_heartbeat_{}, next_configuration_{};
  std::int64_t stepped_deliveries_ = 0;
  bool reported_finished_ = false, logged_wait_ = false;
  std::optional<UTime> waits_since_;
  Duration reported_drift_{};
};

}  // namespace tern
