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
///     vehicle is at rest at its goal and this trajectory holds, it is the answer.
///  2. The path around static obstacles gives the local goal and the cost-to-go (course.h).
///  3. If the start is relaxed, a stop with more room is sought (evasion.h, phase Room).
///  4. The durations are tried: semantic A*, then Eq. 4 for each leaf (durations.h, refinement.h).
///  5. If no candidate is good enough, more is tried: see the table.
///  6. The best new candidate or the committed trajectory is chosen (incumbent.h).
///
/// Steps 3 to 5 depend on whether the vehicle flies *among estimates*: on its way to a goal, with an estimated mover
/// nearby.
///
/// | step | not among estimates                                  | among estimates                                    |
/// |------|------------------------------------------------------|----------------------------------------------------|
/// | 3    | as stated                                            | skipped                                            |
/// | 4    | skipped at the goal, without a path, and if step 3   | skipped if the start is relaxed                    |
/// |      | found a stop                                         |                                                    |
/// | 5    | at rest: up to kSmallerSteps shorter local goals     | reduced assurances until one is settled            |
/// |      | until a plan makes progress; then an evasion if      | (reduced_assurance.h); an evasion only if no       |
/// |      | neither the best nor the committed one holds         | candidate is left                                  |
///
/// Every trajectory in an answer has passed check_plan() or check_separation(). The function is deterministic in its
/// arguments; the workspace never changes an answer. The full list of rungs is in docs/planner/choice.md.
/// @param observer  receives the incumbents and the stages; may be null
PlanAnswer plan(const HorizonRequest& request, const PlanningWorld& world, const PlannerConfig& config, Budget& budget,
                PlanWorkspace& workspace, PlanObserver* observer = nullptr);
/// Plans with a workspace of its own.
PlanAnswer plan(const HorizonRequest& request, const PlanningWorld& world, const PlannerConfig& config, Budget& budget,
                PlanObserver* observer = nullptr);

}  // namespace tern
