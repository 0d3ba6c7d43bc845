// Why there is no way to a goal, for a person.
#pragma once

#include <string>
#include <vector>

#include "planner/planning_world.h"

namespace tern {

/// Where no path leads from `start` to the field's goal: what stands in the way, in words, as it is in W.
/// @param field  made from these (make_goal_field)
std::string blocked_in_words(const GoalField& field, const GoalFieldKey& key, const std::vector<Box>& static_boxes,
                             const Vec3& start);

}  // namespace tern
