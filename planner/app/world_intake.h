// Receives predictions, map and goal, and prepares an immutable PlanningWorld from them.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "core/scenario/scenario.h"
#include "core/world/map_progress.h"
#include "core/world/pose_error_join.h"
#include "planner/app/blocked_goal.h"
#include "planner/app/worker.h"
#include "planner/density_watch.h"
#include "planner/kept_field.h"
#include "planner/static_tracks.h"
#include "runtime/batches.h"
#include "runtime/bus.h"

namespace tern {

/// The vehicle receives a goal at the same time as the planner, and repeats the goal that it flies to. If it still
/// repeats another goal this long afterwards, that other goal is the one in force.
inline constexpr Duration kGoalTaken{500'000};
/// LANDMARK_DENSITIES is repeated for a logger that starts late.
inline constexpr Duration kDensitiesRepeated{1'000'000};

/// Subscribes to POSE_ERROR, PREDICTIONS, SEMANTIC_MAP and GOAL, and prepares the world of plans. With
/// `planner.semantics.learn_densities` and an error price also to FEATURE_TRACKS and ODOMETRY.
///
/// | message                    | effect                                                                              |
/// |----------------------------|-------------------------------------------------------------------------------------|
/// | a complete prediction set  | used at once; its static tracks are remembered                                      |
/// | one without its POSE_ERROR | counted as refused: inconsistent (PoseErrorJoin)                                    |
/// | a complete map             | its fields are made in the background and then used; seconds for a large map        |
/// | a goal to go to            | its distance field is made in the background and then used, again for a new map,    |
/// |                            | new static tracks, body or flight box (kept_field.h)                                |
/// | a goal to hold or stop     | used at once: it needs no field                                                     |
/// | a goal with a smaller id   | ignored, unless the vehicle sends it kGoalTaken after the last one                  |
/// | other contents, same id    | the same, and counted as refused: inconsistent                                      |
/// | features and their pose    | densities of landmarks may change (DensityWatch), and with them the distance field. |
/// |                            | LANDMARK_DENSITIES names them, now and every kDensitiesRepeated                     |
/// | requests of a new vehicle  | goals sent before that flight, remembered static tracks and densities are discarded |
///
/// Without a worker (virtual time) products are made at once.
class WorldIntake {
 public:
  /// @param places  obstacles and regions that messages about a blocked goal call by name
  WorldIntake(Bus& bus, const PlannerConfig& config, const UavSpec& uav, bool in_background,
              std::vector<NamedPlace> places);

  [[nodiscard]] PlanningWorld snapshot() const;
  /// Returns the missing input as text, or "" if a plan can be made.
  [[nodiscard]] std::string missing() const;
  /// Returns why no path led to the newest goal when its field was made: "goal 1 is blocked: …"; "" if one did.
  [[nodiscard]] std::string blocked() const;
  /// Starts the preparation that the newest messages require, unless one is running.
  void prepare();
  /// Sets the vehicle that requests describe: paths are made for its body and flight box from then on. A new sender
  /// epoch means another vehicle and another flight.
  void set_vehicle(const HorizonRequest& request);
  /// Returns the text of the exception that a preparation threw. No further one is started.
  [[nodiscard]] std::optional<std::string> failure() const { return worker_ ? worker_->failure() : std::nullopt; }

 private:
  void on_predictions(const TrackSet& batch);
  void on_map(const MapChunk& chunk);
  void on_goal(const Goal& goal);
  void forget_before(std::int64_t epoch_us);
  void publish_goal_to_hold();
  void publish(std::int64_t number, std::shared_ptr<const GoalProducts> goal,
               std::optional<KeptField> made = std::nullopt);
  void note_blocked(std::string blocked);
  void on_odometry(const Odometry& odometry);
  [[nodiscard]] GoalFieldKey key_now(const MapProducts& map) const;
  [[nodiscard]] GoalFieldInputs names_of(const GoalFieldKey& key);
  void repeat_densities(UTime now);
  [[nodiscard]] bool still_serves(const GoalProducts& goal, const GoalFieldKey& key) const;
  void start(std::function<void()> job);
  void make_map(const VoxelMap& map);

  Bus& bus_;
  PlannerConfig config_;
  const std::vector<NamedPlace> places_;
  BatchCollector<TrackSet> batches_;
  PoseErrorJoin pose_errors_;
  MapAssembler assembler_;
  MapProgress map_progress_;
  StaticTracks statics_;
  std::optional<DensityWatch> densities_;       ///< with `planner.semantics.learn_densities` and an error price
  std::optional<LandmarkDensities> announced_;  ///< of the newest field, unless it has those of the labels
  UTime announced_at_;
  std::optional<VoxelMap> pending_map_;
  std::optional<Goal> newest_goal_;
  UTime goal_received_;
  std::optional<Goal> other_goal_;  ///< the newest goal that was not taken for its id: it may belong to the next flight
  std::int64_t goal_number_ = 0;    ///< counts the values of newest_goal_
  Box body_;                        ///< of the vehicle, about its position
  Box flight_box_;
  Limits limits_;
  Vec3 position_;        ///< of the vehicle, W
  MessageName vehicle_;  ///< the request that described the vehicle last; none: as configured

  mutable std::mutex mutex_;  ///< guards ready_, ready_number_, kept_ and blocked_
  PlanningWorld ready_;
  std::int64_t ready_number_ = 0;  ///< the goal_number_ of ready_.goal
  KeptField kept_;                 ///< the newest field that was published, with its inputs
  std::string blocked_;
  std::unique_ptr<Worker> worker_;  ///< null: prepare at once. Last member: its job uses the others
};

}  // namespace tern
