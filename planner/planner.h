// plan(): one request, one certified answer. Pure: no clock, no log, no state; time enters only through the Budget.
#pragma once

#include "core/world/budget.h"
#include "core/world/horizon.h"
#include "planner/plan_log.h"
#include "planner/planning_world.h"
#include "planner/problem/planner_config.h"

namespace tern {

struct PlanAnswer {
  Plan plan;  ///< header empty
  PlanStatistics statistics;
};

/// Plans from request.start within the sphere of radius r around it (paper §2), in this order:
///  1. The committed trajectory is checked against these predictions: the fallback.
///  2. A start inside a hull seeks room first. Else the path around static obstacles gives the local goal, and the
///     semantic A* looks for a leaf at a few durations.
///  3. Each leaf is optimized by Eq. 4 (`planner.optimization.method`; `alternating`: with its planes fixed).
///  4. If neither that nor the committed trajectory holds long enough, an evasion is sought.
///  5. The best certified trajectory is chosen: separated, hold long enough, least time to the goal, in that order.
/// Every trajectory in an answer has passed check_plan() or check_separation(). Deterministic in its arguments; the
/// workspace is memory, never meaning.
PlanAnswer plan(const HorizonRequest& request, const PlanningWorld& world, const PlannerConfig& config, Budget& budget,
                PlanWorkspace& workspace, PlanObserver* observer = nullptr);
/// The same with memory of its own.
PlanAnswer plan(const HorizonRequest& request, const PlanningWorld& world, const PlannerConfig& config, Budget& budget,
                PlanObserver* observer = nullptr);

}  // namespace tern
