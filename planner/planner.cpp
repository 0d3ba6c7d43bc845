#include "planner/planner.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/world/body.h"
#include "planner/durations.h"
#include "planner/evasion.h"
#include "planner/fallback.h"
#include "planner/incumbent.h"
#include "planner/nearer_goals.h"
#include "planner/plan_workspace.h"
#include "planner/problem/tuning.h"
#include "planner/schedule.h"
#include "planner/stop_rule.h"

namespace tern {
namespace {

/// Returns the fields that are the same in every answer to the request.
Plan blank_plan(const HorizonRequest& request, const PlanningWorld& world, const PlannerConfig& config) {
  Plan p;
  p.request_id = request.id;
  p.sphere_radius = config.sphere_radius_m;
  p.local_goal = request.start.p;
  p.trajectory = request.committed;
  p.inputs.request = request.header.name;
  if (world.goal) {
    p.inputs.goal = world.goal->goal.header.name;
    p.inputs.goal_field = world.goal->made_from;
  }
  if (world.map) p.inputs.map_version = world.map->version;
  if (world.predictions) {
    p.inputs.predictions = world.predictions->set.header.name;
    p.inputs.prediction_set = world.predictions->set.batch.set;
    p.inputs.left_out = world.predictions->set.left_out;
  }
  return p;
}

bool is_usable(const PlanningWorld& world, const HorizonRequest& request, const PlannerConfig& config) {
  if (!world.predictions || !world.map || !world.goal) return false;
  return (request.header.utime - world.predictions->set.made_at).seconds() <= config.stale_after_s;
}

/// Returns whether the vehicle is at rest at the goal, or at rest and told to hold or stop.
bool has_arrived(const HorizonRequest& request, const Goal& goal, const PlannerConfig& config) {
  if (!is_at_rest(request)) return false;
  return goal.mode != GoalMode::Go || (request.start.p - goal.position).norm() <= config.goal_tolerance_m;
}

/// The path around static obstacles, and the courses along it.
class Route {
 public:
  Route(const GoalProducts& goal, const Surroundings& near) : goal_(goal), near_(near) {
    if (goal.goal.mode == GoalMode::Go) path_ = goal.field->path_from(near.request.start.p);
  }

  [[nodiscard]] bool has_path() const { return path_.has_value(); }
  [[nodiscard]] bool is_blocked() const { return !path_ && goal_.goal.mode == GoalMode::Go; }
  /// Returns the task of a vehicle that has not arrived.
  [[nodiscard]] Task task() const {
    if (is_blocked()) return Task::Blocked;
    return path_ ? Task::Fly : Task::Brake;
  }
  /// Returns the course along the path with a local goal of at most this radius. @pre has_path()
  [[nodiscard]] Course along(double radius) const { return course_along(*path_, goal_.field->cost(), radius, near_); }
  [[nodiscard]] Course course() const {
    return has_path() ? along(kLocalGoalShare * near_.config.sphere_radius_m) : course_in_place(near_);
  }
  /// Returns the course straight to a local goal that is nearer by kSmallerStep. @pre has_path()
  [[nodiscard]] Course nearer(const Course& course) const {
    const double step = std::min(course.local.radius, (course.local.goal - near_.request.start.p).norm());
    return course_to_local_goal(along(step / kSmallerStep));
  }

 private:
  const GoalProducts& goal_;
  const Surroundings& near_;
  std::optional<std::vector<Vec3>> path_;  ///< nullopt if there is none, or the goal is to hold or stop
};

PlanReason try_goal(const Surroundings& here, const Course& course, const Trial& trial, const Route& route,
                    Incumbent& incumbent, PlanTools& tools) {
  const PlanReason reason = try_durations(here, course, trial, incumbent, tools);
  if (route.has_path()) {
    try_nearer_goals(
        here, course, [&](double radius) { return route.along(radius); }, trial, incumbent, tools);
  }
  return reason;
}

}  // namespace

PlanAnswer plan(const HorizonRequest& asked, const PlanningWorld& world, const PlannerConfig& config, Budget& budget,
                PlanWorkspace& workspace, PlanObserver* observer) {
  HorizonRequest request = asked;
  request.body = grown(asked.body, asked.tube);
  PlanLog log(observer);
  PlanTools tools{budget, workspace, log};
  log.enter(Stage::Fallback);
  Plan blank = blank_plan(request, world, config);
  if (!is_usable(world, request, config)) {
    blank.reason = PlanReason::StaleWorld;
    return {std::move(blank), {}};
  }
  const Surroundings near = surroundings(request, world, config, workspace);
  blank.relaxed = near.start.relaxed;
  Incumbent incumbent(near, std::move(blank), check_committed(near, tools), tools);
  const bool stays = has_arrived(request, world.goal->goal, config);
  if (stays && is_good_enough(incumbent, {Aim::Stop}, Task::Stay, near)) {
    return {incumbent.answer(PlanReason::AtGoal), log.statistics};
  }
  log.enter(Stage::LocalGoal);
  const Route route(*world.goal, near);
  Course course = route.course();
  if (route.has_path()) incumbent.set_course(course);
  const Task task = stays ? Task::Stay : route.task();
  if (is_among_estimates(task, near) && near.start.relaxed) incumbent.replace_committed(std::nullopt, course);
  PlanReason reason = route.is_blocked() ? PlanReason::GoalBlocked : PlanReason::None;
  for (const Trial& trial : schedule(task, near)) {
    if (is_good_enough(incumbent, trial, task, near)) continue;
    if (trial.is_first_reduced) reason = PlanReason::Infeasible;
    const Surroundings here = at_assurance(trial.assurance, near, workspace);
    if (trial.needs_clear_start && here.start.relaxed) continue;
    if (trial.certifies_committed && !incumbent.committed()) {
      incumbent.replace_committed(check_committed(here, tools), course);
    }
    if (waits(incumbent, trial, near)) break;
    switch (trial.aim) {
      case Aim::Room:
      case Aim::Stop: incumbent.offer_stop(find_evasion(here, course, trial, tools), trial.aim); break;
      case Aim::Step:
        if (budget.expired(Stage::LocalGoal)) break;
        course = route.nearer(course);
        incumbent.set_course(course);
        [[fallthrough]];
      case Aim::Goal: reason = try_goal(here, course, trial, route, incumbent, tools); break;
    }
  }
  return {incumbent.answer(reason), log.statistics};
}

PlanAnswer plan(const HorizonRequest& request, const PlanningWorld& world, const PlannerConfig& config, Budget& budget,
                PlanObserver* observer) {
  PlanWorkspace workspace;
  return plan(request, world, config, budget, workspace, observer);
}

}  // namespace tern
