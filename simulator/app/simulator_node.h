// tern-simulator: the world, its sensor, the vehicle that follows setpoints, and the referee.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/world/flight_result.h"
#include "core/world/goal.h"
#include "core/world/horizon.h"
#include "core/world/voxel_map.h"
#include "runtime/bus.h"
#include "runtime/node.h"
#include "simulator/app/simulator_config.h"
#include "simulator/app/start_gate.h"
#include "simulator/app/world_broadcast.h"
#include "simulator/referee/referee.h"
#include "simulator/vehicle/vehicle.h"

namespace tern {

inline constexpr int kExitNotReady = 3;  ///< a process that the flight needs was not ready in time

/// A flight has three parts.
///   Waiting: everything rests and is declared so, until every process of config.wait_for says Ready. The map of a
///     mapper among them must be here, too: the referee judges its occupied voxels. After config.wait the flight has
///     failed, FLIGHT_RESULT names who is missing, and the exit code is kExitNotReady. Flying: from world zero on (0.3
///     s after the last process was ready, a whole ms) the world moves, and the referee watches. VEHICLE_STATUS says
///     that the vehicle follows, upon which the executor asks for horizons. Ended: VEHICLE_STATUS says so,
///     FLIGHT_RESULT is repeated for a second, the vehicle comes to rest, then the exit code is 0 whatever the verdict.
///     A simulator that was held up for over kSetpointSilence says nothing of the vehicle before it has heard what was
///     sent meanwhile. Its own VEHICLE_STATUS comes back to it after all of that. Held up for over 0.4 s it may have
///     missed setpoints. Then for a moment the vehicle flies on along what it knows to be committed, and VEHICLE_STATUS
///     says that it does not follow. So the executor leads on from where it is. The referee judges the vehicle's true
///     motion. UAV_STATE is what its estimator says, VEHICLE_TRUTH what is so. The goal is the scenario's (id 1, unless
///     config.send_goal is false) until a GOAL with a larger id comes. The newest is repeated at 1 Hz.
class SimulatorNode final : public Node {
 public:
  /// Time begins at bus.clock().now().
  SimulatorNode(Bus& bus, const Scenario& scenario, World world, std::unique_ptr<Vehicle> vehicle,
                const SimulatorConfig& config);

  [[nodiscard]] UTime next_wakeup() const override;
  void step(UTime now) override;
  [[nodiscard]] NodeHealth health() const override;
  [[nodiscard]] std::optional<int> finished() const override;

  [[nodiscard]] const Vehicle& vehicle() const { return *vehicle_; }
  [[nodiscard]] const std::optional<FlightResult>& result() const { return result_; }
  [[nodiscard]] std::optional<UTime> world_zero() const { return world_zero_; }

 private:
  void subscribe_to_external_vehicle();
  void on_heartbeat(const Heartbeat& heartbeat);
  void on_goal(const Goal& goal);
  void on_map(const MapChunk& chunk);
  void take_goal(const Goal& goal);
  [[nodiscard]] std::string missing(UTime now) const;
  void wait_for_processes(UTime now);
  void publish_state(UTime now);
  void publish_status(UTime now);
  [[nodiscard]] bool has_begun(UTime now) const;
  /// Whether setpoints may have been missed: no step for long.
  [[nodiscard]] bool has_missed_setpoints(UTime now) const;
  /// Whether messages of the time in which this process was held up may still be on their way to it.
  [[nodiscard]] bool is_catching_up(UTime now);
  [[nodiscard]] std::string why_not_flying(UTime now) const;
  void admit(UTime now);
  void judge(UTime now);
  void end_flight(const FlightResult& result, int exit_code, UTime now);

  Bus& bus_;
  SimulatorConfig config_;
  StartGate gate_;
  UTime give_up_at_;
  std::unique_ptr<Vehicle> vehicle_;
  Referee referee_;
  MapAssembler map_;
  bool needs_map_ = false;    ///< the flight waits for a mapper, whose map the referee has not got yet
  WorldBroadcast broadcast_;  // of the referee's world
  std::optional<Goal> goal_;
  std::optional<UTime> world_zero_;
  std::optional<FlightResult> result_;
  int exit_code_ = 0;
  int results_left_ = 0;
  bool logged_skewed_ = false;
  UTime last_step_, resumes_at_;
  std::optional<UTime> catching_up_since_;  ///< held up until then, and not everything sent before was heard
  UTime next_state_, next_truth_, next_goal_, next_status_, next_result_ = kNever;
};

}  // namespace tern
