#include "planner/look_ahead.h"

#include <algorithm>

#include "core/wire/message_limits.h"
#include "planner/duration.h"
#include "planner/global_path/local_goal.h"
#include "planner/problem/tuning.h"

namespace tern {
Box committed_box(const HorizonRequest& request) {
  const ClampedSpline spline = request.committed.spline();
  const double from_s = (request.t_s - request.committed.start).seconds();
  Box box(request.start.p);
  for (int j = 0; j < spline.intervals(); ++j) {
    if ((j + 1) * spline.interval_s() >= from_s) box.extend(spline.position_bounds(j));
  }
  return box;
}

Box planning_region(const HorizonRequest& request, const PlannerConfig& config, const Box& committed) {
  const double reach = config.sphere_radius_m + request.body.half_extents().maxCoeff() + kBetaMax;
  const Box sphere = box_around(request.start.p, Vec3::Constant(reach));
  return sphere.merged(grown(committed, request.body.half_extents() + Vec3::Constant(kBetaMax)));
}

LookAhead look_ahead(UTime t_s, const PredictionProducts& predictions, const Box& region) {
  const Foresight foresight = predictions.foresight(region);
  LookAhead look;
  look.followed_until = foresight.followed_until;
  look.followed_s = (foresight.followed_until - t_s).seconds();
  const double predicted_s = (foresight.predicted_until - t_s).seconds();
  look.horizon_s = std::max(predicted_s, std::min(look.followed_s, kMinHorizon));
  return look;
}

double max_planned_duration(const LookAhead& look, const HoldDemand& hold, const PlannerConfig& config) {
  const double held_s = std::min(look.horizon_s - hold.required_s, look.followed_s - hold.cap_s);
  return std::min(held_s, config.intervals * kMaxIntervalDuration.seconds()) / config.duration_scales.front();
}

LocalGoal local_goal_along(const std::vector<Vec3>& path, const MotionSample& start, const Limits& limits,
                           double largest_radius, double longest_s) {
  LocalGoal soonest;
  double radius = largest_radius;
  while (radius >= std::min(kMinRadius, largest_radius)) {
    LocalGoal aim{local_goal(path, start.p, radius), radius, 0.0};
    aim.planned_s = planned_duration(start, aim.goal, limits);
    if (aim.planned_s <= longest_s) return aim;
    if (radius == largest_radius || aim.planned_s < soonest.planned_s) soonest = aim;
    radius *= kRadiusShrink;
  }
  return soonest;
}

double step_scale(double goal_radius) { return std::min(1.0, goal_radius / kFullStep); }

SearchConfig scaled(SearchConfig search, double goal_radius, double planned_s) {
  const double scale = step_scale(goal_radius);
  search.band_m *= scale;
  search.cost_step_m *= scale;
  search.prune_position_m *= scale;
  if (scale < 1.0 || planned_s > kFullStepTime) {
    search.prune_velocity_mps = std::min(search.prune_velocity_mps, kCoarseVelocityShare * goal_radius / planned_s);
  }
  return search;
}

}  // namespace tern
