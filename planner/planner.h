// plan(): one certified answer to one request. It is pure: without clock, log or state. Time enters only by the Budget.
#pragma once

#include "core/world/budget.h"
#include "core/world/horizon.h"
#include "planner/plan_log.h"
#include "planner/planning_world.h"
#include "planner/problem/planner_config.h"

namespace tern {

struct PlanAnswer {
  Plan plan;  ///< its header is empty
  PlanStatistics statistics;
};

/// Plans from request.start within the sphere of radius r around it (paper §2).
///
///  1. The committed trajectory is checked against the predictions: it is the first incumbent (fallback.h). If the
///     vehicle is at rest at its goal and this trajectory is good enough, it is the answer.
///  2. The path around static obstacles gives the task, the local goal and the cost-to-go (course.h).
///  3. The trials of the schedule are tried in order (schedule.h). A trial is left out if the incumbent is good enough
///     for it (stop_rule.h). It searches for stops (evasion.h), or for each duration towards the local goal
///     (durations.h); each leaf is optimized (refinement.h). Its candidates are offered to the incumbent.
///  4. The incumbent answers: with the best new candidate, or with the committed trajectory (preference.h).
///
/// Every trajectory in an answer has passed check_plan() or check_separation(). The function is deterministic in its
/// arguments; the workspace never changes an answer. docs/planner/choice.md states the rule.
/// @param observer  receives the incumbents and the stages; may be null
PlanAnswer plan(const HorizonRequest& request, const PlanningWorld& world, const PlannerConfig& config, Budget& budget,
                PlanWorkspace& workspace, PlanObserver* observer = nullptr);
/// Plans with a workspace of its own.
PlanAnswer plan(const HorizonRequest& request, const PlanningWorld& world, const PlannerConfig& config, Budget& budget,
                PlanObserver* observer = nullptr);

}  // namespace tern
