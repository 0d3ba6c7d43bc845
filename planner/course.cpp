#include "planner/course.h"

#include <algorithm>

#include "planner/duration.h"
#include "planner/problem/tuning.h"

namespace tern {
namespace {

CostToGo cost_to_go_along(const std::vector<Vec3>& path, const TravelCost& cost, double bend_ignored) {
  std::size_t corner = 1;
  double length = 0.0;
  double along = 0.0;
  for (std::size_t k = 1; k < path.size(); ++k) {
    length += (path[k] - path[k - 1]).norm();
    along += cost(path[k - 1], path[k]);
    const bool is_straight = length - (path[k] - path[0]).norm() <= bend_ignored;
    if (k == 1 || (is_straight && cost(path[0], path[k]) - along <= bend_ignored)) corner = k;
  }
  CostToGo cost_to_go{path[corner], 0.0};
  for (std::size_t k = corner + 1; k < path.size(); ++k) cost_to_go.rest += (path[k] - path[k - 1]).norm();
  return cost_to_go;
}

double length_of(const FlownTime& flown, const Course& course) {
  return std::max(flown.min_s, flown.share * course.step_s);
}

}  // namespace

Course course_in_place(const Surroundings& near) {
  const Vec3& at = near.request.start.p;
  const LocalGoal local{at, kLocalGoalShare * near.config.sphere_radius_m,
                        planned_duration(near.request.start, at, near.pace_limits)};
  return {local, {at, 0.0}, 0.0, near.pace_limits, near.fields};
}

Course course_along(const std::vector<Vec3>& path, const TravelCost& cost, double largest_radius,
                    const Surroundings& near) {
  const MotionSample& start = near.request.start;
  const LocalGoal local = local_goal_along(path, start, near.pace_limits, largest_radius,
                                           max_planned_duration(near.look, near.hold, near.config));
  return {local, cost_to_go_along(path, cost, kBendIgnored * step_scale(local.radius)), local.planned_s,
          paced(near.pace_limits, (local.goal - start.p).norm()), near.fields};
}

Course course_to_local_goal(Course course) {
  course.cost_to_go = {course.local.goal, course.cost_to_go.from(course.local.goal)};
  course.fields = nullptr;
  return course;
}

double progress_share(const Vec3& from, const Vec3& local_goal, const TimedSpline& trajectory) {
  const double to_go = (local_goal - from).norm();
  const Vec3 end = trajectory.control_points.rightCols<1>();
  return to_go > 0.0 ? 1.0 - (local_goal - end).norm() / to_go : 0.0;
}

SemanticGuide guide_of(const Surroundings& near, const Course& course) {
  return {*course.fields, near.config.semantic_cost, near.request.start.p, course.local.goal};
}

double arrival_estimate(const Course& course, const TimedSpline& trajectory, UTime from) {
  const ClampedSpline spline = trajectory.spline();
  const double offset_s = (from - trajectory.start).seconds();
  double sum = 0.0;
  for (const FlownTime& flown : kFlownTimes) {
    const double while_s = length_of(flown, course);
    const MotionSample at = spline.sample(offset_s + while_s);
    sum += while_s + min_duration(at, course.cost_to_go.point, course.pace) +
           course.cost_to_go.rest / course.pace.v_max.minCoeff();
  }
  return 0.5 * sum;
}

double arrival_with_exposure(const Surroundings& near, const Course& course, const TimedSpline& trajectory) {
  const UTime from = near.request.t_s;
  const double arrival_s = arrival_estimate(course, trajectory, from);
  if (course.fields == nullptr || near.config.semantic_cost == SemanticCost::MeanDistance) return arrival_s;
  const SemanticGuide guide = guide_of(near, course);
  const ClampedSpline spline = trajectory.spline();
  double metres = 0.0;
  const double offset_s = (from - trajectory.start).seconds();
  for (const FlownTime& flown : kFlownTimes) metres += 0.5 * guide.of(spline, offset_s, length_of(flown, course));
  return arrival_s + metres / near.pace_limits.v_max.minCoeff();
}

}  // namespace tern
