// How far ahead one request looks: the longest plan and hold, and the distance of the local goal. See
// docs/planner/holds.md.
#pragma once

#include <vector>

#include "core/world/horizon.h"
#include "planner/hold.h"
#include "planner/planning_world.h"
#include "planner/problem/planner_config.h"

namespace tern {

/// Returns a box in W around the centre's positions on the committed trajectory from t_s on. It may reach far out of
/// the sphere around the start.
Box committed_box(const HorizonRequest& request);

/// Returns a box in W around all points that the body may touch from t_s on. The body flies the committed trajectory or
/// any trajectory within the sphere.
/// @param committed  committed_box()
Box planning_region(const HorizonRequest& request, const PlannerConfig& config, const Box& committed);

/// Times are seconds after t_s. A negative time is past; a very large one means that no mover is within reach.
struct LookAhead {
  UTime followed_until = kForever;  ///< no plan, hold included, lasts beyond this time (Foresight)
  double followed_s = 0.0;          ///< the same after t_s, s
  double horizon_s = 0.0;           ///< a plan to the local goal ends, and holds, within this time
};

/// Returns how far ahead a request at t_s looks.
///
/// The horizon is as long as movers are predicted within the region, and at least min(kMinHorizon, followed_s). Beyond
/// the predictions, growing boxes stand for the movers.
/// @param region  planning_region()
LookAhead look_ahead(UTime t_s, const PredictionProducts& predictions, const Box& region);

/// The local goal s_g^temp.
struct LocalGoal {
  Vec3 goal = Vec3::Zero();  ///< last point of the path within this radius of the start, W
  double radius = 0.0;       ///< m
  double planned_s = 0.0;    ///< planned_duration() to it, s
};

/// Returns the longest planned_duration() to a local goal, s. With the first duration scale, the plan and its hold fit
/// into the horizon, and Δt is at most kMaxIntervalDuration.
double max_planned_duration(const LookAhead& look, const HoldDemand& hold, const PlannerConfig& config);

/// Returns the local goal at the largest of the radii largest_radius, kRadiusShrink · largest_radius, … for which
/// planned_duration() ≤ longest_s. If there is none, since the start is too fast to stop so soon, it returns the one
/// with the shortest planned duration.
/// @pre path is not empty
LocalGoal local_goal_along(const std::vector<Vec3>& path, const MotionSample& start, const Limits& limits,
                           double largest_radius, double longest_s);

/// Returns the factor by which the search's lengths shrink for a local goal nearer than kFullStep, (0, 1].
double step_scale(double goal_radius);
/// Returns the search's configuration for a local goal at this radius, planned_s seconds away.
///
/// Bands, steps of cost and pruning distances shrink by step_scale(). The pruning velocity follows the mean speed of
/// the step. Small and slow steps are thus resolved as finely as large ones. At kFullStep and beyond, within
/// kFullStepTime, the configured lengths apply.
SearchConfig scaled(SearchConfig search, double goal_radius, double planned_s);

}  // namespace tern
