// A goal field that is kept while the vehicle's tube and the bounds of obstacles at rest change.
#pragma once

#include <memory>
#include <vector>

#include "planner/planning_world.h"
#include "planner/static_tracks.h"

namespace tern {

/// Body and obstacles are rounded up to this for a field with an error price, and on an estimate, m. Such a field takes
/// time. The measured tube and, on an estimate, the bounds of obstacles change several times a second.
inline constexpr double kFieldStep = 0.1;

/// A goal field, and the inputs that it holds for.
struct KeptField {
  std::shared_ptr<const GoalField> field;
  GoalFieldKey key;               ///< the wanted one, or one with a larger body
  std::vector<Box> static_boxes;  ///< they may be larger than the wanted ones
  bool is_blocked = false;        ///< around all boxes no way led from the start: it serves equal keys only
};

/// Returns make_goal_field(key, …). With an error price (speed > 0), and on an estimate (map_margin > 0), the sides of
/// body and static boxes are first rounded up to kFieldStep. The field then serves while they change. If no way leads
/// from the start for these, the field is the one for body and boxes as they are. A function of its arguments: a replay
/// makes the same field of them.
KeptField make_kept_field(const GoalFieldKey& key, const std::shared_ptr<const MapProducts>& map,
                          std::vector<Box> static_boxes, const Vec3& start);

/// The same for static and resting obstacles and with the map's margin. If every way from the start is closed, resting
/// obstacles are left out, since they may move. If that opens none, the margin is left out, then both.
KeptField make_kept_field(const GoalFieldKey& key, const std::shared_ptr<const MapProducts>& map,
                          const PathObstacles& obstacles, const Vec3& start);

/// Whether a field also serves other inputs. It serves equal keys. If it is rounded, it also serves a body and static
/// boxes that its own contain, each smaller by at most 3 kFieldStep per side. A blocked field does not: a smaller body
/// may find a way.
/// @param static_boxes  those whose digest is wanted.statics
bool serves(const KeptField& kept, const GoalFieldKey& wanted, const std::vector<Box>& static_boxes);

}  // namespace tern
