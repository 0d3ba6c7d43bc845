// What Foxglove's 3D panel draws of a flight, in its own well-known schemas.
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

struct Drawing {
  std::string
      topic;  ///< "/tern/uav", "/tern/obstacles", "/tern/committed", "/tern/plan", "/tern/hulls", "/tern/planes",
              ///< "/tern/regions"
  std::string schema;  ///< "foxglove.PoseInFrame" or "foxglove.SceneUpdate"
  Json message;
};

/// The vehicle's pose of UAV_STATE, the true obstacles as cubes, the committed path of a request and the path of a plan
/// as lines. All in frame "W", at the time of receipt. Nothing for other messages, and for an answer without a plan.
std::optional<Drawing> drawing_of(const LoggedMessage& message);

/// What a plan stands on: where the moving obstacles within 3 m of it may be while it is flown (predicted_hulls.h).
/// Besides, of each certificate plane a patch where it stands between vehicle and obstacle (plane_place.h). Each takes
/// the place of those of the plan before. Nothing for an answer without a plan.
/// @param t_s     of the request that was answered
/// @param tracks  the prediction set that the plan names
std::vector<Drawing> drawings_of(const Plan& plan, UTime t_s, const TrackSet& tracks, std::int64_t received_us);

/// A semantic map: an entity per label and class, of boxes (box_cover.h), named by class in its text and its metadata
/// ("label", "class"). It replaces the map before.
Drawing drawing_of(const VoxelMap& map, std::int64_t received_us);

/// The part of Foxglove's schema that drawing_of() uses.
Json foxglove_schema(const std::string& name);

/// The schema of one of Tern's message types (message_types.h), with its units and comments.
Json message_schema(const std::string& type);

}  // namespace tern::exporting
