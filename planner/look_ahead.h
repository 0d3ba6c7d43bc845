// How far ahead one request looks: how long plans and holds may be, and how far the local goal may lie.
#pragma once

#include <vector>

#include "core/world/horizon.h"
#include "planner/hold.h"
#include "planner/planning_world.h"
#include "planner/problem/planner_config.h"

namespace tern {

/// Where the vehicle's centre may be from t_s on if nothing new is flown, W. It may lie far out of the sphere around
/// the start.
Box committed_box(const HorizonRequest& request);

/// What the body may touch from t_s on, flying what is committed or anything within the sphere, W.
/// @param committed  committed_box()
Box planning_region(const HorizonRequest& request, const PlannerConfig& config, const Box& committed);

/// Times count from t_s, s; negative ones are past, very large ones mean that nothing moves within reach.
struct LookAhead {
  UTime followed_until = kForever;  ///< no plan, hold included, looks past this time (Foresight)
  double followed_s = 0.0;          ///< the same
  double horizon_s = 0.0;           ///< plans that head for the local goal end, and hold, within this
};

/// The horizon is as long as movers are predicted within the planning region. It is at least kMinHorizon, or as long
/// as they are followed: where predictions are short, boxes that grow stand for them.
/// @param region  planning_region()
LookAhead look_ahead(UTime t_s, const PredictionProducts& predictions, const Box& region);

/// Where a plan heads.
struct LocalGoal {
  Vec3 goal = Vec3::Zero();  ///< s_g^temp: the last point of the path in the ball of this radius about the start, W
  double radius = 0.0;       ///< m
  double planned_s = 0.0;    ///< planned_duration() to it
};

/// The largest planned_duration() to the local goal, s: it and the hold after it fit into the horizon, and Δt is at
/// most kMaxIntervalDuration.
double max_planned_duration(const LookAhead& look, const HoldDemand& hold, const PlannerConfig& config);

/// The local goal at the first of `largest_radius` and radii that shrink by a sixth with planned_duration() ≤
/// longest_s. Where there is none (the start is too fast to stop so soon), the one that is reached first.
/// @pre path is not empty
LocalGoal local_goal_along(const std::vector<Vec3>& path, const MotionSample& start, const Limits& limits,
                           double largest_radius, double longest_s);

/// By how much lengths shrink with a local goal nearer than kFullStep, (0, 1].
double step_scale(double goal_radius);
/// The search's lengths (bands, steps of cost, voxels that prune) for local goals at this radius. Likewise its coarse
/// velocity for a flight there of so many seconds. So small and slow steps are resolved as well as large ones. At
/// kFullStep and beyond, within kFullStepTime, they are the configured ones.
SearchConfig scaled(SearchConfig search, double goal_radius, double planned_s);

}  // namespace tern
