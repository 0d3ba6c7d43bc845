// Messages in, an immutable PlanningWorld out: what plans are made from, prepared off the hot path.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "core/world/scenario.h"
#include "planner/app/blocked_goal.h"
#include "planner/app/worker.h"
#include "planner/planning_world.h"
#include "planner/static_tracks.h"
#include "runtime/batches.h"
#include "runtime/bus.h"

namespace tern {

/// The vehicle hears a goal when the planner does, and repeats it from then on.
inline constexpr Duration kGoalTaken{500'000};

/// Subscribes PREDICTIONS, SEMANTIC_MAP and GOAL. A map's fields and a goal's distances take up to seconds. A worker
/// makes them in the background, and they are used once they are ready; without one (virtual time) they are made at
/// once. To hold or stop needs neither: such a goal counts from the moment it comes.
///
/// The goal with the largest id counts, but the vehicle knows best: what it repeats kGoalTaken after another one came
/// is what it has taken.
class WorldIntake {
 public:
  /// @param places  what may be called by its name where no way leads to a goal
  WorldIntake(Bus& bus, const PlannerConfig& config, const UavSpec& uav, bool in_background,
              std::vector<NamedPlace> places);

  [[nodiscard]] PlanningWorld snapshot() const;
  /// What is still missing, as text; empty when a plan can be made.
  [[nodiscard]] std::string missing() const;
  /// Starts the preparation that the newest messages ask for, if none runs.
  void prepare();
  /// The vehicle as a request describes it: paths are made for its body and flight box from then on. A new sender epoch
  /// means another vehicle and another flight: goals sent before it began and static tracks of the former one are
  /// forgotten.
  void set_vehicle(const HorizonRequest& request);
  /// The text of what a preparation threw; none is made any more.
  [[nodiscard]] std::optional<std::string> failure() const { return worker_ ? worker_->failure() : std::nullopt; }

 private:
  void on_predictions(const TrackSet& batch);
  void on_map(const MapChunk& chunk);
  void on_goal(const Goal& goal);
  void forget_before(std::int64_t run_us);
  void hold();
  void publish(std::int64_t number, std::shared_ptr<const GoalProducts> goal);
  void start(std::function<void()> job);
  void make_map(const VoxelMap& map);

  Bus& bus_;
  PlannerConfig config_;
  const std::vector<NamedPlace> places_;
  BatchCollector<TrackSet> batches_;
  MapAssembler assembler_;
  StaticTracks statics_;
  std::optional<VoxelMap> pending_map_;
  std::optional<Goal> newest_goal_;
  UTime goal_heard_;
  std::optional<Goal> overruled_goal_;  ///< the newest with a smaller id: another flight's, if there comes one
  std::int64_t goal_number_ = 0;        ///< counts what newest_goal_ was
  Box body_;                            ///< about its position
  Box flight_box_;
  Vec3 at_;
  MessageName vehicle_;  ///< the request that described it last; none: as configured

  mutable std::mutex mutex_;  ///< guards ready_ and ready_number_
  PlanningWorld ready_;
  std::int64_t ready_number_ = 0;   ///< the goal_number_ of ready_.goal
  std::unique_ptr<Worker> worker_;  ///< null: at once. Last: its job uses the others
};

}  // namespace tern
