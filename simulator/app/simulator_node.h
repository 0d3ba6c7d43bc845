// tern-simulator: the world, its sensor, the vehicle that flies plans, and the referee. Perfect tracking.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/world/flight_result.h"
#include "core/world/goal.h"
#include "core/world/horizon.h"
#include "executor/executor.h"
#include "runtime/bus.h"
#include "runtime/node.h"
#include "simulator/app/simulator_config.h"
#include "simulator/app/start_gate.h"
#include "simulator/app/world_broadcast.h"
#include "simulator/referee/referee.h"

namespace tern {

inline constexpr int kExitNotReady = 3;  ///< a process that the flight needs was not ready in time

/// A flight has three parts.
///   Waiting: everything rests and is declared so, until every process of config.wait_for says Ready. After config.wait
///   the
///     flight has failed, FLIGHT_RESULT names who is missing, and the exit code is kExitNotReady.
///   Flying: from world zero on (0.3 s after the last process was ready, a whole ms) the world moves, the executor asks
///   for
///     horizons while there is a goal, and the referee watches.
///   Ended: FLIGHT_RESULT is repeated for a second, the vehicle comes to rest, then the exit code is 0 whatever the
///   verdict.
/// The goal is the scenario's (id 1, unless config.send_goal is false) until a GOAL with a larger id comes; the newest
/// is repeated at 1 Hz.
class SimulatorNode final : public Node {
 public:
  /// Time begins at bus.clock().now().
  SimulatorNode(Bus& bus, const Scenario& scenario, World world, const SimulatorConfig& config,
                const ExecutorConfig& executor);

  [[nodiscard]] UTime next_wakeup() const override;
  void step(UTime now) override;
  [[nodiscard]] NodeHealth health() const override;
  [[nodiscard]] std::optional<int> finished() const override;

  [[nodiscard]] const Executor& executor() const { return executor_; }
  [[nodiscard]] const std::optional<FlightResult>& result() const { return result_; }
  [[nodiscard]] std::optional<UTime> world_zero() const { return world_zero_; }

 private:
  void on_heartbeat(const Heartbeat& heartbeat);
  void on_goal(const Goal& goal);
  void on_plan(const Plan& plan);
  void take_goal(const Goal& goal);
  void wait_for_processes(UTime now);
  void ask(UTime now);
  void publish_state(UTime now);
  void judge(UTime now);
  void end_flight(const FlightResult& result, int exit_code, UTime now);
  void log_end() const;

  Bus& bus_;
  SimulatorConfig config_;
  StartGate gate_;
  UTime give_up_at_;
  Executor executor_;
  Referee referee_;
  WorldBroadcast broadcast_;  // of the referee's world
  std::optional<Goal> goal_;
  std::optional<UTime> world_zero_;
  std::optional<FlightResult> result_;
  int exit_code_ = 0;
  int results_left_ = 0;
  bool said_skewed_ = false;
  double yaw_ = 0.0;  // rad, along the last horizontal velocity
  UTime next_state_, next_goal_, next_result_ = kNever;
  UTime next_refusal_log_;
  std::int64_t refusals_unsaid_ = 0;
};

}  // namespace tern
