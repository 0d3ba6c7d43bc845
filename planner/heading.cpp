#include "planner/heading.h"

#include <algorithm>

#include "planner/duration.h"
#include "planner/problem/tuning.h"

namespace tern {
namespace {

WayToGo way_along(const std::vector<Vec3>& path, const TravelCost& cost, double bend_ignored) {
  std::size_t corner = 1;
  double length = 0.0;
  double along = 0.0;
  for (std::size_t k = 1; k < path.size(); ++k) {
    length += (path[k] - path[k - 1]).norm();
    along += cost(path[k - 1], path[k]);
    const bool is_straight = length - (path[k] - path[0]).norm() <= bend_ignored;
    if (k == 1 || (is_straight && cost(path[0], path[k]) - along <= bend_ignored)) corner = k;
  }
  WayToGo way{path[corner], 0.0};
  for (std::size_t k = corner + 1; k < path.size(); ++k) way.rest += (path[k] - path[k - 1]).norm();
  return way;
}

double length_of(const While& shall, const Heading& heading) {
  return std::max(shall.least_s, shall.share * heading.step_s);
}

}  // namespace

Heading heading_nowhere(const Surroundings& near) {
  const Vec3& at = near.request.start.p;
  const LocalAim local{at, kLocalGoalShare * near.config.sphere_radius_m,
                       planned_duration(near.request.start, at, near.pace_limits)};
  return {local, {at, 0.0}, 0.0, near.pace_limits, near.fields};
}

Heading heading_along(const std::vector<Vec3>& path, const TravelCost& cost, double largest_radius,
                      const Surroundings& near) {
  const MotionSample& start = near.request.start;
  const LocalAim local = aim_along(path, start, near.pace_limits, largest_radius,
                                   longest_first_duration(near.look, near.hold, near.config));
  return {local, way_along(path, cost, kBendIgnored * step_scale(local.radius)), local.least_s,
          paced(near.pace_limits, (local.goal - start.p).norm()), near.fields};
}

Heading step_along(Heading heading) {
  heading.way = {heading.local.goal, heading.way.from(heading.local.goal)};
  heading.fields = nullptr;
  return heading;
}

double share_of_way(const Vec3& from, const Vec3& local_goal, const TimedSpline& trajectory) {
  const double to_go = (local_goal - from).norm();
  const Vec3 end = trajectory.control_points.rightCols<1>();
  return to_go > 0.0 ? 1.0 - (local_goal - end).norm() / to_go : 0.0;
}

SemanticGuide guide_of(const Surroundings& near, const Heading& heading) {
  return {*heading.fields, near.config.semantic_cost, near.request.start.p, heading.local.goal};
}

double arrival_estimate(const Heading& heading, const TimedSpline& trajectory, UTime from) {
  const ClampedSpline spline = trajectory.spline();
  const double offset_s = (from - trajectory.start).seconds();
  double sum = 0.0;
  for (const While& shall : kWhiles) {
    const double while_s = length_of(shall, heading);
    const MotionSample at = spline.sample(offset_s + while_s);
    sum += while_s + least_duration(at, heading.way.point, heading.pace) +
           heading.way.rest / heading.pace.v_max.minCoeff();
  }
  return 0.5 * sum;
}

double worth_of(const Surroundings& near, const Heading& heading, const TimedSpline& trajectory) {
  const UTime from = near.request.t_s;
  const double arrival_s = arrival_estimate(heading, trajectory, from);
  if (heading.fields == nullptr || near.config.semantic_cost == SemanticCost::MeanDistance) return arrival_s;
  const SemanticGuide guide = guide_of(near, heading);
  const ClampedSpline spline = trajectory.spline();
  double metres = 0.0;
  const double offset_s = (from - trajectory.start).seconds();
  for (const While& shall : kWhiles) metres += 0.5 * guide.of(spline, offset_s, length_of(shall, heading));
  return arrival_s + metres / near.pace_limits.v_max.minCoeff();
}

}  // namespace tern
