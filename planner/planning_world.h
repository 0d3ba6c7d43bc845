// The world of a plan: immutable products of predictions, map and goal, prepared before requests come in.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/world/goal.h"
#include "core/world/horizon.h"
#include "core/world/landmark_densities.h"
#include "core/world/track.h"
#include "core/world/vehicle.h"
#include "core/world/voxel_map.h"
#include "planner/global_path/box_index.h"
#include "planner/global_path/goal_field.h"
#include "planner/problem/planner_config.h"
#include "planner/safety/swept_obstacles.h"
#include "planner/semantics/belief.h"
#include "planner/semantics/error_price.h"
#include "planner/semantics/semantic_fields.h"
#include "planner/semantics/surface_map.h"
#include "planner/static_tracks.h"
#include "planner/unseen/unseen_watch.h"

namespace tern {

/// The time until which a region without movers is known.
inline constexpr UTime kForever{std::numeric_limits<std::int64_t>::max()};

/// How long the movers within a region are known.
struct Foresight {
  UTime predicted_until =
      kForever;  ///< from then on a mover may be in the region without a piece that predicts it there
  UTime followed_until = kForever;  ///< until then every mover in the region is in the box of a track found there
};

/// A complete prediction set with boxes around each track's motion, and an index over them. The cost of a plan thus
/// depends on the tracks within its reach, not on all tracks.
struct PredictionProducts {
  TrackSet set;
  std::vector<Box> piece_boxes;             ///< one per piece of each moving track
  std::vector<PlanningObstacle> obstacles;  ///< one per track; they point into this object, so it is never copied
  BoxIndex index;                           ///< over the obstacles' boxes

  explicit PredictionProducts(TrackSet tracks);
  PredictionProducts(const PredictionProducts&) = delete;
  PredictionProducts& operator=(const PredictionProducts&) = delete;

  /// Returns how long the movers within a region are known. A mover can be in the box of its pieces, which grows at its
  /// top speed after its last piece. A track that `index` does not find there enters the region at followed_until or
  /// later. O(tracks).
  [[nodiscard]] Foresight foresight(const Box& region) const;

 private:
  /// A moving track, for foresight().
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
  BoxIndex occupied;  ///< the obstacle voxels, merged into boxes
  SemanticFields fields;
  bool semantic_paths = false;           ///< paths around static obstacles include the exposure cost
  SurfaceMap surfaces;                   ///< with an error price: the landmarks that labels promise
  std::vector<std::string> class_names;  ///< with an error price: VoxelMap::class_names
  double error_price = 0.0;  ///< m/m; > 0: paths include the price of their drift instead of the exposure cost

  MapProducts(const VoxelMap& map, const PlannerConfig& config);
};

/// The inputs of a goal field. For one configuration, equal keys give equal fields.
struct GoalFieldKey {
  Vec3 goal = Vec3::Zero();
  std::uint64_t map_version = 0;
  std::uint64_t statics = 0;               ///< digest of the static boxes
  Box body{Vec3(0, 0, 0), Vec3(0, 0, 0)};  ///< the body about its position, by which obstacles are grown, m
  Box flight_box;
  double speed = 0.0;                              ///< of the way, with an error price, m/s; else 0
  double map_margin = 0.0;                         ///< PathObstacles::map_margin, m
  std::optional<SurfaceDensities> densities = {};  ///< with an error price; nullopt: those of the labels
  friend bool operator==(const GoalFieldKey& a, const GoalFieldKey& b) {
    return a.goal == b.goal && a.map_version == b.map_version && a.statics == b.statics && a.speed == b.speed &&
           a.map_margin == b.map_margin && a.densities == b.densities && a.body.min() == b.body.min() &&
           a.body.max() == b.body.max() && a.flight_box.min() == b.flight_box.min() &&
           a.flight_box.max() == b.flight_box.max();
  }
};

/// Returns the speed that GoalFieldKey states: kCruiseShare of the vehicle's least horizontal v_max, or 0 without an
/// error price.
double way_speed(const MapProducts& map, const Limits& limits);

/// Returns the field of distances to a goal around the boxes of map and static tracks. Distances include the exposure
/// cost if map->semantic_paths, or the price of drift with an error price. Takes about 100 ms, with regions about 300
/// ms, with an error price as much. The field keeps the map alive.
/// @param static_boxes  boxes of static tracks, not inflated, W
/// @param start  enlarges the region that is searched
GoalField make_goal_field(const GoalFieldKey& key, const std::shared_ptr<const MapProducts>& map,
                          const std::vector<Box>& static_boxes, const Vec3& start);

/// A goal and the field of distances to it.
struct GoalProducts {
  Goal goal;
  GoalFieldKey key;
  std::shared_ptr<const GoalField> field;  ///< null if no field was ever made: the goal is to hold or stop
  GoalFieldInputs made_from;               ///< the inputs of `field`, as a plan reports them
};

/// Returns the error that the way from start to the field's goal is expected to leave; nullopt without an error price
/// or a way.
std::optional<ForetoldError> foretell_error(const GoalField& field, const Vec3& start, double speed);

/// The snapshot for one call of plan(). A null member has not been received or prepared.
struct PlanningWorld {
  std::shared_ptr<const PredictionProducts> predictions;
  std::shared_ptr<const MapProducts> map;
  std::shared_ptr<const GoalProducts> goal;
  std::shared_ptr<const UnseenKnowledge> unseen;  ///< read with `planner.unseen: passive`; null: nothing is known
};

}  // namespace tern
