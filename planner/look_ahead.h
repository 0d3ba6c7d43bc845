// How far ahead one request looks: how long plans and holds may be, and how far the local goal may lie.
#pragma once

#include <optional>
#include <vector>

#include "core/world/horizon.h"
#include "planner/planner_config.h"
#include "planner/planning_world.h"

namespace tern {

/// Where the vehicle's centre may be from t_s on if nothing new is flown, W. It may lie far out of the sphere around
/// the start.
Box committed_box(const HorizonRequest& request);

/// What the body may touch from t_s on, flying what is committed or anything within the sphere, W.
Box planning_region(const HorizonRequest& request, const PlannerConfig& config);

/// Times count from t_s, s; negative ones are past, very large ones mean that nothing moves within reach.
struct LookAhead {
  UTime followed_until = kFollowedForEver;  ///< no plan, hold included, looks past this time (Foresight)
  double followed_s = 0.0;                  ///< the same
  double horizon_s = 0.0;                   ///< plans that head for the local goal end, and hold, within this
};

/// The horizon is as long as movers are predicted within the planning region. It is at least kLeastHorizon, or as long
/// as they are followed: where predictions are short, boxes that grow stand for them.
inline constexpr double kLeastHorizon = 3.0;  // s
LookAhead look_ahead(const HorizonRequest& request, const PredictionProducts& predictions, const PlannerConfig& config);

/// The same configuration with holds of at most half the horizon, so that flying has the other half. Nothing: it asks
/// for no longer ones.
std::optional<PlannerConfig> with_shorter_holds(const PlannerConfig& config, const LookAhead& look);

/// Where a plan heads.
struct LocalAim {
  Vec3 goal = Vec3::Zero();  ///< s_g^temp: the last point of the path in the ball of this radius about the start, W
  double radius = 0.0;       ///< m
  double least_s = 0.0;      ///< planned_duration() to it
};

/// The local goal at `largest_radius`, or, where the first duration to it and the hold after it do not fit into the
/// horizon, or Δt would exceed kLongestInterval, at the next smaller of radii that shrink by a sixth which does. Where
/// none does (the start is too fast to stop so soon), the one that is reached first.
/// @pre path is not empty
LocalAim aim_along(const std::vector<Vec3>& path, const MotionSample& start, const Limits& limits,
                   double largest_radius, const LookAhead& look, const PlannerConfig& config);

/// Local goals at least this far away are as far as the search's lengths were chosen for, m.
inline constexpr double kFullStep = 2.0;
/// By how much lengths shrink with a nearer local goal, (0, 1].
double step_scale(double goal_radius);
/// The search's lengths (bands, steps of cost, voxels that prune) for local goals at this radius, and its coarse
/// velocity for a flight there of so many seconds, so that small and slow steps are told apart as well as large ones.
/// At kFullStep and beyond, within kFullStepTime, they are the configured ones.
inline constexpr double kFullStepTime = 4.0;  // s
SearchConfig scaled(SearchConfig search, double goal_radius, double least_s);

}  // namespace tern
