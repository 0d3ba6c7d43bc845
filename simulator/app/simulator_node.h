// tern-simulator: the world, its sensor, the vehicle and the referee.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/world/flight_result.h"
#include "core/world/goal.h"
#include "core/world/horizon.h"
#include "core/world/map_progress.h"
#include "runtime/bus.h"
#include "runtime/node.h"
#include "simulator/app/sensor_broadcast.h"
#include "simulator/app/simulator_config.h"
#include "simulator/app/start_gate.h"
#include "simulator/app/vio_sensors.h"
#include "simulator/app/world_broadcast.h"
#include "simulator/referee/believed_arrival.h"
#include "simulator/referee/referee.h"
#include "simulator/vehicle/vehicle.h"

namespace tern {

inline constexpr int kExitNotReady = 3;  ///< a required process was not ready in time

/// Runs one flight.
///
/// | part    | begins                                               | world (WorldBroadcast)   | vehicle       |
/// |---------|------------------------------------------------------|--------------------------|---------------|
/// | Waiting | at start                                             | at rest, and declared so | not following |
/// | Flying  | at world zero: 0.3 s after all are ready, a whole ms | moves; the referee judges | follows      |
/// | Ended   | at the verdict                                       | moves                    | not following |
///
/// World zero is 1.5 s after all are ready if motions are not declared.
///
/// Waiting: all processes of config.wait_for must report Ready. If a mapper is among them, its map must be received,
/// since the referee judges its occupied voxels. After config.wait the flight has failed: FLIGHT_RESULT names the
/// missing processes, and the exit code is kExitNotReady. The wait is longer by two rotations of the map: a process may
/// join within a rotation, or lose a chunk.
///
/// Ended: FLIGHT_RESULT is repeated for a second while the vehicle comes to rest. Then the exit code is 0, for every
/// verdict.
///
/// A vehicle that estimates its own pose may believe that it is at the goal while it hovers elsewhere. Then the flight
/// ends by BelievedArrival. The verdict is about the truth, so it is Timeout. Its detail begins with
/// kReachedAsBelieved, and has the true distance and the bound that the estimator states.
///
/// The referee judges the vehicle's true motion (VEHICLE_TRUTH). UAV_STATE is the estimator's output. The goal is the
/// scenario's, with id 1, unless config.send_goal is false. A GOAL with a larger id replaces it. It is repeated at 1
/// Hz.
///
/// With config.goals_from, that process decides by its HEARTBEAT. An arrival counts once it reports Finished. If it
/// reports Failed, the verdict is Timeout with its reason.
///
/// If this process was held up for more than kSetpointSilence, it publishes no vehicle message until its own
/// VEHICLE_STATUS has come back. By then it has received all messages that were sent meanwhile. If it was held up for
/// more than 0.4 s, setpoints may be lost. VEHICLE_STATUS then reports *not following* for a moment, and the vehicle
/// flies its committed trajectory. The executor continues from the vehicle's position.
class SimulatorNode final : public Node {
 public:
  /// Time begins at bus.clock().now().
  SimulatorNode(Bus& bus, const Scenario& scenario, World world, std::unique_ptr<Vehicle> vehicle,
                const SimulatorConfig& config);

  [[nodiscard]] UTime next_wakeup() const override;
  void step(UTime now) override;
  [[nodiscard]] NodeHealth health() const override;
  [[nodiscard]] std::optional<int> finished() const override;
  /// The obstacles' names: "obstacle 12: people#7".
  [[nodiscard]] std::vector<std::string> notes() const override;

  [[nodiscard]] const Vehicle& vehicle() const { return *vehicle_; }
  [[nodiscard]] const std::optional<FlightResult>& result() const { return result_; }
  [[nodiscard]] std::optional<UTime> world_zero() const { return world_zero_; }

 private:
  void subscribe_to_external_vehicle();
  void on_heartbeat(const Heartbeat& heartbeat);
  void on_goal(const Goal& goal);
  void on_map(const MapChunk& chunk);
  void take_goal(const Goal& goal);
  void obey(const Heartbeat& heartbeat);
  [[nodiscard]] std::string missing(UTime now) const;
  void wait_for_processes(UTime now);
  void publish_state(UTime now);
  void publish_status(UTime now);
  [[nodiscard]] bool has_begun(UTime now) const;
  /// Whether setpoints may have been lost, since the last step is long ago.
  [[nodiscard]] bool has_missed_setpoints(UTime now) const;
  /// Whether messages that were sent while this process was held up may still be on their way.
  [[nodiscard]] bool is_catching_up(UTime now);
  [[nodiscard]] std::string why_not_flying(UTime now) const;
  void admit(UTime now);
  [[nodiscard]] UTime judged_until(UTime now) const;
  void judge(UTime now);
  void judge_belief(UTime now);
  void end_without_truth(UTime now);
  void end_flight(const FlightResult& result, int exit_code, UTime now);

  Bus& bus_;
  SimulatorConfig config_;
  double timeout_s_;
  StartGate gate_;
  UTime begun_, give_up_at_;
  std::unique_ptr<Vehicle> vehicle_;
  Referee referee_;
  MapAssembler map_;
  MapProgress map_progress_;
  bool needs_map_ = false;    ///< the flight waits for the mapper's map, for the referee
  WorldBroadcast broadcast_;  // of the referee's world
  SensorBroadcast sensors_;
  std::optional<VioSensors> vio_;
  BelievedArrival believed_arrival_;
  MotionSample setpoint_;
  std::optional<Goal> goal_;
  std::optional<UTime> world_zero_;
  std::optional<FlightResult> result_;
  int exit_code_ = 0;
  int results_left_ = 0;
  bool logged_skewed_ = false;
  UTime last_step_, resumes_at_;
  std::optional<UTime> catching_up_since_;  ///< set while messages from before this time are on their way
  UTime next_state_, next_truth_, next_goal_, next_status_, next_result_ = kNever;
};

}  // namespace tern
