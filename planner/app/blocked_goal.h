// The reason why no path leads to a goal, as text for people.
#pragma once

#include <string>
#include <vector>

#include "core/scenario/scenario.h"
#include "planner/planning_world.h"

namespace tern {

/// An obstacle or region with a name in the scenario, which paths go around.
struct NamedPlace {
  bool is_obstacle = false;  ///< false for a region of an occupied class
  Region where;
};

/// Returns the scenario's named static obstacles, and its regions of occupied classes.
std::vector<NamedPlace> named_places(const Scenario& scenario);

/// Returns the reason why no path leads from `start` to the field's goal, with positions in W.
/// @param field   made from key and static_boxes (make_goal_field)
/// @param places  the obstacles and regions that are called by name
std::string blocked_goal_text(const GoalField& field, const GoalFieldKey& key, const std::vector<Box>& static_boxes,
                              const Vec3& start, const std::vector<NamedPlace>& places);

}  // namespace tern
