// Watches a flight by its messages: what to show of it now, when it has ended and how, and its summary.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/world/flight_result.h"
#include "core/world/goal.h"
#include "core/world/horizon.h"
#include "core/world/observation.h"
#include "core/world/replan_samples.h"
#include "core/world/scenario.h"
#include "core/world/vehicle.h"
#include "monitor/duplicate_filter.h"
#include "monitor/flight_summary.h"
#include "monitor/process_table.h"
#include "monitor/request_ledger.h"

namespace tern {

inline constexpr char kSimulatorProcess[] = "tern-simulator";
inline constexpr char kExecutorProcess[] = "tern-executor";
/// Without a heartbeat of the simulator for so long, there is no flight.
inline constexpr Duration kSimulatorSilence{20'000'000};
/// After the verdict every process has a last heartbeat to send, with its last counts.
inline constexpr Duration kLastReports{600'000};
/// Without a heartbeat of it for so long, a simulator that another one follows has ended: four may be lost.
inline constexpr Duration kSuccessorSilence{2'500'000};
/// The referee has this much longer than the scenario's own timeout to say something.
inline constexpr Duration kResultSlack{60'000'000};

/// What a live line shows.
struct LiveView {
  bool flying = false;     ///< a horizon was asked for; else the rest but `waiting` and `beside` is meaningless
  std::string waiting;     ///< who is not ready, and why
  std::string beside;      ///< "2 tern-predictor": processes of which more than one live; empty when there is none
  double elapsed_s = 0.0;  ///< since the first request, vehicle's clock
  double progress = 0.0;   ///< of the straight distance from start to goal, 0 … 1
  double speed_mps = 0.0;
  double nearest_m = 0.0;  ///< distance of the body's box to the nearest obstacle; NaN: none known
  /// The same to the map's occupied voxels; NaN: none known.
  double nearest_wall_m = std::numeric_limits<double>::quiet_NaN();
  double replan_p50_ms = 0.0, replan_p99_ms = 0.0;  ///< of all answers so far; NaN: none
  std::int64_t requests = 0, answered_in_time = 0;
  PlanReason reason = PlanReason::None;  ///< the newest plan's
  std::int32_t left_out = 0;             ///< tracks that the newest plan knew nothing of
};

/// How a flight ended.
struct Ending {
  FlightOutcome outcome = FlightOutcome::Failed;
  std::string detail;
};

/// Pure: messages and times come in, values go out.
///
/// The flight ends kLastReports after FLIGHT_RESULT, with its outcome. Before that it has failed in four cases:
///  - fail() was called (the launcher knows of a process that cannot run).
///  - The simulator was not heard for kSimulatorSilence, from the watch's beginning on.
///  - The simulator started anew after the first request, and the one that the flight began with is silent: its world
///    is lost.
///  - The referee says nothing kResultSlack after the scenario's timeout.
/// Verdict and loss of the world are those of the simulator that the flight began with, whoever else says so. A verdict
/// that its own next heartbeat contradicts (it flies on) is dropped.
class FlightWatch {
 public:
  /// @param now  the watcher's clock, as everywhere here unless the vehicle's is named
  FlightWatch(const Scenario& scenario, UTime now);

  void receive(const Heartbeat& heartbeat, UTime now);
  void receive(const UavState& state);
  void receive(const Goal& goal);
  void receive(const HorizonRequest& request, UTime now);
  void receive(const Plan& plan) { ledger_.add(plan); }
  void receive(const PlanTiming& timing);
  void receive(const FlightResult& result, UTime now);
  /// A complete set.
  void receive(std::vector<TrueObstacle> obstacles) { obstacles_ = std::move(obstacles); }
  /// The newest map's occupied voxels (cover_with_boxes()).
  void receive_map(std::vector<Box> occupied) { occupied_ = std::move(occupied); }
  /// Something outside of the messages made the flight impossible. The first reason stays.
  void fail(std::string detail);

  [[nodiscard]] std::optional<Ending> ending(UTime now) const;
  [[nodiscard]] LiveView live() const;
  /// All but log and version, which the watch does not know.
  [[nodiscard]] FlightSummary summary(const Ending& ending) const;

 private:
  [[nodiscard]] double nearest_obstacle() const;
  [[nodiscard]] double nearest_wall() const;
  [[nodiscard]] std::int64_t simulator_epoch_us() const;
  [[nodiscard]] std::optional<std::string> failure(UTime now) const;

  Scenario scenario_;
  Vec3 goal_;
  UTime began_;
  ProcessTable processes_;
  RequestLedger ledger_;
  std::optional<UavState> state_;
  std::optional<HorizonRequest> first_request_;
  std::optional<UTime> first_request_at_;
  std::int64_t world_epoch_us_ = 0;  ///< the simulator's at the first request; 0: none yet
  UTime beat_;                       ///< when a heartbeat was heard last
  std::vector<TrueObstacle> obstacles_;
  std::vector<Box> occupied_;
  DuplicateFilter timings_filter_;
  ReplanSamples replan_;
  std::optional<FlightResult> result_;
  UTime result_at_;
  std::string failure_;
};

}  // namespace tern
