// Why there is no way to a goal, for a person.
#pragma once

#include <string>
#include <vector>

#include "core/world/scenario.h"
#include "planner/planning_world.h"

namespace tern {

/// What a scenario calls by name and a path has to go around.
struct NamedPlace {
  bool is_obstacle = false;  ///< else it is a region of an occupied class
  Region where;
};

/// The scenario's own obstacles that rest, as far as they have names, and its regions of occupied classes.
std::vector<NamedPlace> named_places(const Scenario& scenario);

/// Where no path leads from `start` to the field's goal: what stands in the way, in words, as it is in W.
/// @param field  made from these (make_goal_field)  @param places  what may be called by its name
std::string blocked_in_words(const GoalField& field, const GoalFieldKey& key, const std::vector<Box>& static_boxes,
                             const Vec3& start, const std::vector<NamedPlace>& places);

}  // namespace tern
