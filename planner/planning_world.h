// What a plan is made from, prepared off the hot path: immutable products of predictions, map and goal.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/world/goal.h"
#include "core/world/track.h"
#include "core/world/vehicle.h"
#include "core/world/voxel_map.h"
#include "planner/global_path/box_index.h"
#include "planner/global_path/goal_field.h"
#include "planner/planner_config.h"
#include "planner/safety/swept_obstacles.h"
#include "planner/semantics/semantic_fields.h"

namespace tern {

/// A complete prediction set with a box around each track's whole motion.
struct PredictionProducts {
  TrackSet set;
  std::vector<PlanningObstacle> obstacles;  ///< one per track; point into `set`, so this object does not move
  std::vector<Box> static_boxes;            ///< of the static tracks, not inflated, by id
  std::uint64_t static_digest = 0;          ///< names static_boxes

  explicit PredictionProducts(TrackSet tracks);
  PredictionProducts(const PredictionProducts&) = delete;
  PredictionProducts& operator=(const PredictionProducts&) = delete;
};
/// How far past its last piece a track's box is followed: no plan looks farther.
inline constexpr Duration kTrackBoxReach{4'000'000};

/// One version of the map.
struct MapProducts {
  std::uint64_t version = 0;
  BoxIndex occupied;       ///< voxels that are obstacles, as few boxes
  SemanticFields fields;

  MapProducts(const VoxelMap& map, const PlannerConfig& config);
};

/// A goal and the distances to it around static obstacles.
struct GoalProducts {
  Goal goal;
  GoalField field;
  std::uint64_t map_version = 0;
  std::uint64_t static_digest = 0;
  Vec3 body_half = Vec3::Zero();  ///< what the obstacles were grown by
  Box flight_box;

  GoalProducts(const Goal& goal, const MapProducts& map, const PredictionProducts& predictions, const Body& body,
               const Box& flight_box, const Vec3& start);
};

/// The snapshot of one planning call. A null member: not there yet.
struct PlanningWorld {
  std::shared_ptr<const PredictionProducts> predictions;
  std::shared_ptr<const MapProducts> map;
  std::shared_ptr<const GoalProducts> goal;
};

/// Where the vehicle's centre may be: the flight box shrunk by the body.
Box centre_box(const Box& flight_box, const Body& body);

}  // namespace tern
