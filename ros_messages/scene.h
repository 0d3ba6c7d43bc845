// Draws Tern's values as scenes of Foxglove (foxglove_msgs/msg/SceneUpdate).
#pragma once

#include <cstdint>

#include "core/world/horizon.h"
#include "core/world/observation.h"
#include "core/world/track.h"
#include "core/world/voxel_map.h"
#include "ros_messages/conversions.h"
#include "ros_messages/scene_types.h"

namespace tern::ros {

/// Colours of lines.
inline constexpr Color kCommittedColor{0.09, 0.2, 0.31, 1.0}, kPlanColor{0.25, 0.64, 0.3, 1.0};

/// The drawing of one moment. Coordinates are rounded to 2⁻⁹ m (2 mm): their doubles end in zeros and compress to a
/// third. A shape of the same function replaces the previous one.
class SceneDrawing {
 public:
  explicit SceneDrawing(Frames frames, UTime at) : frames_(std::move(frames)), at_(at) {}

  /// True obstacles as cubes: moving ones orange, static ones grey.
  [[nodiscard]] SceneUpdate obstacles(const ObstacleTruth& complete_set) const;
  /// A trajectory as a line. @param id  of the entity
  [[nodiscard]] SceneUpdate line(const TimedSpline& trajectory, const std::string& id, const Color& color) const;
  /// Where moving obstacles within 3 m of the plan may be while it is flown (core/drawing/predicted_hulls.h).
  /// @param tracks  the prediction set that the plan names
  [[nodiscard]] SceneUpdate hulls(const Plan& plan, const TrackSet& tracks) const;
  /// A patch of each separating plane, between vehicle and obstacle (core/drawing/plane_place.h).
  /// @param t_s  of the request that was answered
  [[nodiscard]] SceneUpdate planes(const Plan& plan, UTime t_s) const;
  /// A semantic map: an entity per label and class, made of boxes (core/world/box_cover.h). Its text and its metadata
  /// ("label", "class") name the class. It replaces the previous map.
  [[nodiscard]] SceneUpdate regions(const VoxelMap& map) const;

 private:
  [[nodiscard]] SceneEntity entity(const std::string& id) const;
  [[nodiscard]] SceneUpdate scene(SceneEntity entity) const;

  Frames frames_;
  UTime at_;
};

}  // namespace tern::ros
