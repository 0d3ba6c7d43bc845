// Watches a flight by its messages: the live view, the flight's end and its summary.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/scenario/scenario.h"
#include "core/world/flight_result.h"
#include "core/world/goal.h"
#include "core/world/horizon.h"
#include "core/world/observation.h"
#include "core/world/replan_samples.h"
#include "core/world/vehicle.h"
#include "monitor/certified_share.h"
#include "monitor/duplicate_filter.h"
#include "monitor/estimate_watch.h"
#include "monitor/flight_evidence.h"
#include "monitor/flight_summary.h"
#include "monitor/process_table.h"
#include "monitor/recording_watch.h"
#include "monitor/request_ledger.h"

namespace tern {

inline constexpr char kSimulatorProcess[] = "tern-simulator";
inline constexpr char kExecutorProcess[] = "tern-executor";
/// If the simulator sends no heartbeat for this long, the flight has failed.
inline constexpr Duration kSimulatorSilence{20'000'000};
/// After the verdict each process has this long to send a last heartbeat with its final counts.
inline constexpr Duration kLastReports{600'000};
/// A simulator that another one follows has ended if it sends no heartbeat for this long: four may be lost.
inline constexpr Duration kSuccessorSilence{2'500'000};
/// The referee may publish its verdict this long after the scenario's timeout.
inline constexpr Duration kResultSlack{60'000'000};

/// The values of the live line.
struct LiveView {
  bool flying = false;     ///< a request was sent; if false, only `waiting` and `beside` are valid
  std::string waiting;     ///< processes that are not ready, and why
  std::string concurrent;  ///< "2 tern-predictor": processes of which several run; may be empty
  double elapsed_s = 0.0;  ///< since the first request, vehicle's clock
  double progress = 0.0;   ///< share of the straight distance from start to goal, 0 … 1
  double speed_mps = 0.0;
  double nearest_m = 0.0;  ///< distance from the body's box to the nearest obstacle; NaN: none known
  /// Distance from the body's box to the map's occupied voxels; NaN: none known.
  double nearest_wall_m = std::numeric_limits<double>::quiet_NaN();
  double replan_p50_ms = 0.0, replan_p99_ms = 0.0;  ///< over all answers so far, by the system's clock; NaN: none
  double pace = 1.0;                                ///< seconds of flight per second of the system's clock
  std::int64_t requests = 0, answered_in_time = 0;
  PlanReason reason = PlanReason::None;  ///< of the newest plan
  std::int32_t left_out = 0;             ///< tracks missing in the predictions of the newest plan
};

/// How a flight ended.
struct Ending {
  FlightOutcome outcome = FlightOutcome::Failed;
  std::string detail;
};

/// Judges a flight by its messages. Pure: messages and times come in, values go out.
///
/// The flight ends kLastReports after FLIGHT_RESULT, with that outcome. It has failed if one of these comes first:
/// - fail() is called (the launcher reports a process that cannot run).
/// - The simulator sends no heartbeat for kSimulatorSilence, from the watch's beginning on.
/// - Another simulator has started after the first request, and the flight's own is silent for kSuccessorSilence: its
///   world is lost.
/// - There is no FLIGHT_RESULT kResultSlack after the scenario's timeout.
///
/// Only a FLIGHT_RESULT of the simulator with which the flight began is accepted. It is dropped if that simulator's
/// next heartbeat shows that it still flies.
class FlightWatch {
 public:
  /// @param scenario  with the flight's time limit (runtime/timed_scenario.h)
  /// @param now  the watcher's clock, as in all functions here; the vehicle's clock is named where it is meant
  FlightWatch(const Scenario& scenario, UTime now);

  void receive(const Heartbeat& heartbeat, UTime now);
  void receive(const UavState& state);
  void receive(const Goal& goal);
  void receive(const HorizonRequest& request, UTime now);
  void receive(const Plan& plan);
  void receive(const PlanTiming& timing);
  void receive(const PlanUnseen& unseen) { certified_.add(unseen); }
  void receive(const VehicleStatus& status) { note(status); }
  void receive(const Odometry& odometry) {
    if (!result_) estimate_.add(odometry);
  }
  void receive_truth(const UavState& truth) {
    if (!result_) estimate_.add_truth(truth);
  }
  void receive(const TrackSet& predictions) { note(predictions); }
  void receive(const ObservationSet& observations) { note(observations); }
  void receive(const ConfigurationReport& report) { note(report); }
  void receive(const FlightResult& result, UTime now);
  /// @param obstacles  of a complete set
  void receive(std::vector<TrueObstacle> obstacles) { obstacles_ = std::move(obstacles); }
  /// @param occupied  the newest map's occupied voxels (cover_with_boxes())
  void receive_map(std::vector<Box> occupied) { occupied_ = std::move(occupied); }
  /// Says that the flight's clocks can be slowed, and how fast they run (`--pace`). Without it no slower pace is
  /// recommended.
  void set_pace(double pace) { pace_ = pace; }
  /// Ends the flight for a reason outside the messages. The first reason stays.
  void fail(std::string detail);

  [[nodiscard]] std::optional<Ending> ending(UTime now) const;
  [[nodiscard]] LiveView live() const;
  /// The summary except log and version, which the watch does not know.
  [[nodiscard]] FlightSummary summary(const Ending& ending) const;
  /// How wrong the vehicle's own estimate was; nullopt if it has none. It is beside the summary, since few vehicles do.
  [[nodiscard]] std::optional<EstimateMeasures> estimate() const { return estimate_.measures(goal_); }

 private:
  [[nodiscard]] double nearest_obstacle() const;
  [[nodiscard]] double nearest_wall() const;
  [[nodiscard]] std::int64_t simulator_epoch_us() const;
  [[nodiscard]] std::optional<std::string> failure(UTime now) const;
  /// Messages after the verdict explain nothing.
  void note(const auto& message) {
    if (!result_) evidence_.receive(message);
  }

  Scenario scenario_;
  Vec3 goal_;
  UTime began_;
  ProcessTable processes_;
  RequestLedger ledger_;
  CertifiedShare certified_;
  FlightEvidence evidence_;
  EstimateWatch estimate_;
  RecordingWatch recording_;
  std::optional<double> pace_;
  std::optional<UavState> state_;
  std::optional<HorizonRequest> first_request_;
  std::optional<UTime> first_request_at_;
  std::int64_t world_epoch_us_ = 0;  ///< the simulator's epoch at the first request; 0: none yet
  UTime beat_;                       ///< time of the last heartbeat
  std::vector<TrueObstacle> obstacles_;
  std::vector<Box> occupied_;
  DuplicateFilter timings_filter_;
  ReplanSamples replan_;
  std::optional<FlightResult> result_;
  UTime result_at_;
  std::string failure_;
};

}  // namespace tern
