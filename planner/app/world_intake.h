// Messages in, an immutable PlanningWorld out: what plans are made from, prepared off the hot path.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "core/world/scenario.h"
#include "planner/app/worker.h"
#include "planner/planning_world.h"
#include "runtime/batches.h"
#include "runtime/bus.h"

namespace tern {

/// Subscribes PREDICTIONS, SEMANTIC_MAP and GOAL. A map's fields and a goal's distances take up to seconds: with a
/// worker they are made in the background and used once they are ready, without one at once (virtual time).
class WorldIntake {
 public:
  WorldIntake(Bus& bus, const PlannerConfig& config, const UavSpec& uav, bool in_background);

  [[nodiscard]] PlanningWorld snapshot() const;
  /// What is still missing, in words; empty when a plan can be made.
  [[nodiscard]] std::string missing() const;
  /// Starts the preparation that the newest messages ask for, if none runs.
  void prepare();
  /// The vehicle as a request describes it: paths are made for this body and flight box from then on.
  void set_vehicle(const Body& body, const Box& flight_box, const Vec3& at);
  /// Sets of which a batch was lost.
  [[nodiscard]] std::int64_t incomplete_sets() const { return batches_.incomplete(); }

 private:
  void on_predictions(const TrackSet& batch);
  void on_map(const MapChunk& chunk);
  void on_goal(const Goal& goal);
  void remember_statics(const TrackSet& set);
  void start(std::function<void()> job);
  void make_map(VoxelMap map);

  PlannerConfig config_;
  BatchCollector<TrackSet> batches_;
  MapAssembler assembler_;
  std::map<std::int64_t, Box> statics_;  ///< all static tracks ever heard of this predictor epoch
  std::int64_t statics_epoch_ = 0;
  std::vector<Box> static_boxes_;
  std::uint64_t static_digest_ = 0;
  std::optional<VoxelMap> pending_map_;
  std::optional<Goal> newest_goal_;
  Vec3 body_half_;
  Box flight_box_;
  Vec3 at_;

  mutable std::mutex mutex_;  ///< guards ready_
  PlanningWorld ready_;
  std::unique_ptr<Worker> worker_;  ///< null: at once. Last: its job uses the others
};

}  // namespace tern
