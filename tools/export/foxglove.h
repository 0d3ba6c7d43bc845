// Converts messages to Foxglove's schemas, for its 3D panel.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/world/horizon.h"
#include "core/world/track.h"
#include "core/world/voxel_map.h"
#include "tools/export/logged_messages.h"

namespace tern::exporting {

/// One message on one Foxglove topic.
struct Drawing {
  /// "/tern/uav", "/tern/obstacles", "/tern/committed", "/tern/plan", "/tern/hulls", "/tern/planes", "/tern/regions"
  std::string topic;
  std::string schema;  ///< "foxglove.PoseInFrame" or "foxglove.SceneUpdate"
  Json message;
};

/// Converts a message: UAV_STATE to a pose, OBSTACLE_TRUTH to cubes, the committed trajectory of a request and the
/// trajectory of a plan to lines. The frame is "W", the time that of receipt.
/// @return nullopt for other messages, and for an answer without a trajectory
std::optional<Drawing> drawing_of(const LoggedMessage& message);

/// Draws what a plan was checked against. Hulls: where moving obstacles within 3 m of the plan may be while it is flown
/// (predicted_hulls.h). Planes: a patch of each separating plane, between vehicle and obstacle (plane_place.h). Both
/// replace those of the previous plan.
/// @return empty for an answer without a trajectory
/// @param t_s     of the request that was answered
/// @param tracks  the prediction set that the plan names
std::vector<Drawing> drawings_of(const Plan& plan, UTime t_s, const TrackSet& tracks, std::int64_t received_us);

/// Draws a semantic map: an entity per label and class, made of boxes (box_cover.h). Its text and its metadata
/// ("label", "class") name the class. It replaces the previous map.
Drawing drawing_of(const VoxelMap& map, std::int64_t received_us);

/// Returns the part of Foxglove's schema that the functions above use.
Json foxglove_schema(const std::string& name);

/// Returns the JSON schema of one of Tern's message types (message_types.h), with units and comments.
Json message_schema(const std::string& type);

}  // namespace tern::exporting
