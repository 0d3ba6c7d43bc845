// Repeats plan() under the conditions of a recorded answer.
#pragma once

#include <optional>

#include "core/world/plan_heading.h"
#include "planner/planner.h"
#include "tools/replay/world_rebuilder.h"

namespace tern {

/// An answer that was planned again.
struct Replanned {
  Plan plan;  ///< the header and the inputs that the node adds are copied from the recorded answer
  std::optional<PlanStatistics>
      statistics;  ///< nullopt for an answer of the watchdog, since the worker's plan() ended later
};

/// Plans again, and ends each loop at the count that `recorded` states. The watchdog may have sent an incumbent before
/// the worker was done. Then the same incumbent is returned, or the last one if there are fewer.
Replanned replan(const PlanProblem& problem, const Plan& recorded);

/// Plans the heading of an answer again, from the yaw and rate with which the recorded one starts. These depend on the
/// heading before, which the planner remembered.
/// @param plan  the answer that was planned again
/// @return nullopt if this plan gets no heading
std::optional<PlanHeading> replan_heading(const PlanProblem& problem, const Plan& plan, const PlanHeading& recorded);

}  // namespace tern
