// What a plan is made from, prepared off the hot path: immutable products of predictions, map and goal.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "core/world/goal.h"
#include "core/world/horizon.h"
#include "core/world/track.h"
#include "core/world/vehicle.h"
#include "core/world/voxel_map.h"
#include "planner/global_path/box_index.h"
#include "planner/global_path/goal_field.h"
#include "planner/problem/planner_config.h"
#include "planner/safety/swept_obstacles.h"
#include "planner/semantics/semantic_fields.h"
#include "planner/static_tracks.h"

namespace tern {

/// Where nothing moves.
inline constexpr UTime kForever{std::numeric_limits<std::int64_t>::max()};

/// Until when movers are known within a region.
struct Foresight {
  UTime predicted_until = kForever;  ///< from then on something may be there though no piece of a track says so
  UTime followed_until = kForever;   ///< until then the boxes of what is found there hold every track
};

/// A complete prediction set with boxes around each track's motion, and an index over them. So a plan costs what is in
/// its reach, not what is in the world.
struct PredictionProducts {
  TrackSet set;
  std::vector<Box> piece_boxes;             ///< of all moving tracks, one per piece of their motions
  std::vector<PlanningObstacle> obstacles;  ///< one per track; point into this object, so that it does not move
  BoxIndex index;                           ///< over the obstacles' boxes

  explicit PredictionProducts(TrackSet tracks);
  PredictionProducts(const PredictionProducts&) = delete;
  PredictionProducts& operator=(const PredictionProducts&) = delete;

  /// A track counts where it can be: its pieces' box, which grows at its top speed from its last piece on. Tracks that
  /// `index` does not find in the region reach it at followed_until at the earliest. O(tracks).
  [[nodiscard]] Foresight foresight(const Box& region) const;

 private:
  /// A track that moves, as foresight() takes it.
  struct Mover {
    MotionBoxes boxes;
    double top_speed;
  };
  const Mover& add_mover(const Track& track);

  std::vector<Mover> movers_;
};

/// One version of the map.
struct MapProducts {
  std::uint64_t version = 0;
  BoxIndex occupied;  ///< voxels that are obstacles, as few boxes
  SemanticFields fields;
  bool weighs_paths = false;  ///< paths around static obstacles know what regions cost

  MapProducts(const VoxelMap& map, const PlannerConfig& config);
};

/// What a goal field was made from; equal keys, equal fields, for one configuration.
struct GoalFieldKey {
  Vec3 goal = Vec3::Zero();
  std::uint64_t map_version = 0;
  std::uint64_t statics = 0;               ///< digest of the static boxes
  Box body{Vec3(0, 0, 0), Vec3(0, 0, 0)};  ///< about its position: what the obstacles were grown by, m
  Box flight_box;
  friend bool operator==(const GoalFieldKey& a, const GoalFieldKey& b) {
    return a.goal == b.goal && a.map_version == b.map_version && a.statics == b.statics &&
           a.body.min() == b.body.min() && a.body.max() == b.body.max() && a.flight_box.min() == b.flight_box.min() &&
           a.flight_box.max() == b.flight_box.max();
  }
};

/// The distances to a goal around the boxes of map and static tracks (not inflated), weighed by the exposure cost where
/// the map says so. About 100 ms, with regions some 300. The field keeps the map.
/// @param start  enlarges the region that is searched
GoalField make_goal_field(const GoalFieldKey& key, const std::shared_ptr<const MapProducts>& map,
                          const std::vector<Box>& static_boxes, const Vec3& start);

/// A goal and the way there.
struct GoalProducts {
  Goal goal;
  GoalFieldKey key;
  std::shared_ptr<const GoalField> field;  ///< null for a goal to hold or stop before there was a way to any
  GoalFieldInputs made_from;               ///< what `field` was made from, as a plan names it
};

/// The snapshot of one planning call. A null member: not there yet.
struct PlanningWorld {
  std::shared_ptr<const PredictionProducts> predictions;
  std::shared_ptr<const MapProducts> map;
  std::shared_ptr<const GoalProducts> goal;
};

}  // namespace tern
