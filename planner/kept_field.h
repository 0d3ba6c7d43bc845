// A goal field with an error price that is kept while the vehicle's tube changes.
#pragma once

#include <memory>
#include <vector>

#include "planner/planning_world.h"

namespace tern {

/// The sides of a body are rounded up to this for a field with an error price, m. Such a field takes time, and the
/// measured tube changes several times a second.
inline constexpr double kBodyStep = 0.1;

/// A goal field, and the key that it was made for.
struct KeptField {
  std::shared_ptr<const GoalField> field;
  GoalFieldKey key;
};

/// Returns make_goal_field(key, …). With an error price the sides of the body are first rounded up to kBodyStep, so
/// that the field serves while the tube changes. If no way leads from the start for that body, the field is the one for
/// the body as it is. A function of its arguments: a replay makes the same field of them.
KeptField make_kept_field(const GoalFieldKey& key, const std::shared_ptr<const MapProducts>& map,
                          const std::vector<Box>& static_boxes, const Vec3& start);

/// Whether the field of one key also serves another. It serves an equal one. With an error price (speed > 0) it also
/// serves each body that it contains and that is smaller by at most 3 kBodyStep per side.
bool serves(const GoalFieldKey& made_for, const GoalFieldKey& wanted);

}  // namespace tern
