// All processes of a flight as nodes of one virtual network. Each can be stopped and restarted.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/scenario/scenario.h"
#include "runtime/virtual_runner.h"

namespace tern {

class ExecutorNode;
class SimulatorNode;

/// How planning takes virtual time. Nothing else does: messages arrive at once, and other processes take no time.
enum class Charge {
  Counts,  ///< 15 ms per answer; loops end by their own limits, so a flight is a function of its inputs
  Cpu,     ///< the thread's CPU time; budget and watchdog end a plan by it, so a slow plan is late or incomplete
};
/// Returns "counts" or "cpu".
const char* to_string(Charge charge);

/// Starts simulator, executor, predictor, mapper and planner of one scenario file on a VirtualRunner, and tern-mission
/// if simulator.goals_from names it. The planner has no threads.
class VirtualSystem {
 public:
  /// @param begin   start time, µs > 0
  /// @param master  the flight's key: every process signs and verifies; nullopt: no keys
  /// @throws ConfigError for inputs that run_process() would refuse
  VirtualSystem(const std::string& scenario_file, const std::vector<std::string>& overrides,
                Charge charge = Charge::Counts, UTime begin = UTime{1'000'000}, const std::optional<Key>& master = {});
  ~VirtualSystem();

  /// Kills a process that is not the simulator: "tern-planner", "tern-mission". The next start() makes a new one
  /// without memory.
  /// @throws std::invalid_argument for other names
  void stop(const std::string& process);
  void start(const std::string& process);

  /// Returns the runner: time, the bus for observers, run().
  [[nodiscard]] VirtualRunner& runner() { return runner_; }
  [[nodiscard]] const SimulatorNode& simulator() const { return *simulator_; }
  /// Returns the executor that was started last. @pre it is not stopped
  [[nodiscard]] const ExecutorNode& executor() const { return *executor_; }
  [[nodiscard]] const Scenario& scenario() const;
  /// Returns the scenario with the flight's time limit (timed()), for a FlightWatch.
  [[nodiscard]] Scenario timed_scenario() const;

 private:
  struct Parts;  ///< the inputs of the nodes

  std::unique_ptr<Parts> parts_;
  VirtualRunner runner_;
  const SimulatorNode* simulator_ = nullptr;
  const ExecutorNode* executor_ = nullptr;
};

}  // namespace tern
