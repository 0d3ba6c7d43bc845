// The processes of a flight as nodes of one virtual network; each can be stopped and started again.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/world/scenario.h"
#include "runtime/virtual_runner.h"

namespace tern {

class ExecutorNode;
class SimulatorNode;

/// What planning costs in virtual time. In neither case anything else does: messages arrive at once, and what live
/// processes do beside the planner's worker takes no time.
enum class Charge {
  Counts,  ///< 15 ms per answer, whatever it took; loops end by their own limits. A flight is a function of its inputs
  Cpu,     ///< the thread's CPU time; budget and watchdog end a plan by it, so a slow plan is a late or a poor one
};
/// "counts", "cpu".
const char* to_string(Charge charge);

/// Simulator, executor, predictor, mapper and planner of one scenario file on a VirtualRunner, all started. The planner
/// has no threads.
class VirtualSystem {
 public:
  /// @param begin   when time begins, µs > 0
  /// @param master  the flight's key: every process signs and verifies; nullopt: none does
  /// @throws ConfigError for what run_process would refuse.
  VirtualSystem(const std::string& scenario_file, const std::vector<std::string>& overrides,
                Charge charge = Charge::Counts, UTime begin = UTime{1'000'000}, const std::optional<Key>& master = {});
  ~VirtualSystem();

  /// Kills "tern-executor", "tern-predictor", "tern-mapper" or "tern-planner"; the next start() makes a new one that
  /// knows nothing.
  /// @throws std::invalid_argument for other names.
  void stop(const std::string& process);
  void start(const std::string& process);

  /// Time, the bus for those who watch, run().
  [[nodiscard]] VirtualRunner& runner() { return runner_; }
  [[nodiscard]] const SimulatorNode& simulator() const { return *simulator_; }
  /// The one that was started last. @pre it was not stopped
  [[nodiscard]] const ExecutorNode& executor() const { return *executor_; }
  [[nodiscard]] const Scenario& scenario() const;

 private:
  struct Parts;  // what the nodes are made from

  std::unique_ptr<Parts> parts_;
  VirtualRunner runner_;
  const SimulatorNode* simulator_ = nullptr;
  const ExecutorNode* executor_ = nullptr;
};

}  // namespace tern
