#include "planner/planner.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/world/body.h"
#include "planner/durations.h"
#include "planner/evasion.h"
#include "planner/fallback.h"
#include "planner/incumbent.h"
#include "planner/plan_workspace.h"
#include "planner/problem/tuning.h"
#include "planner/reduced_assurance.h"

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

/// Returns whether the vehicle is at rest at the goal, or at rest and told to hold or stop. It then only has to stay
/// clear.
bool has_reached_goal(const HorizonRequest& request, const Goal& goal, const PlannerConfig& config) {
  if (!is_at_rest(request)) return false;
  return goal.mode != GoalMode::Go || (request.start.p - goal.position).norm() <= config.goal_tolerance_m;
}

/// Returns the path around static obstacles; nullopt if there is none, empty if the goal is to hold or stop.
std::optional<std::vector<Vec3>> path_to_goal(const GoalProducts& goal, const Vec3& from) {
  if (goal.goal.mode != GoalMode::Go) return std::vector<Vec3>{};
  return goal.field->path_from(from);
}

/// Tries smaller and smaller steps until a candidate makes progress.
/// @param course_at  returns the course along the path with a local goal at a radius
/// @param course     changed to the last course
/// @param reason     the reason if there is no plan so far
/// @return the reason if there is no plan
PlanReason try_smaller_steps(const Surroundings& near, const auto& course_at, Course& course, PlanReason reason,
                             Incumbent& incumbent, PlanTools& tools) {
  for (int k = 0; k < kSmallerSteps && !incumbent.makes_progress(); ++k) {
    if (tools.budget.expired(Stage::LocalGoal)) break;
    const double step = std::min(course.local.radius, (course.local.goal - near.request.start.p).norm());
    course = course_to_local_goal(course_at(step / kSmallerStep));
    incumbent.set_course(course);
    reason = try_durations(near, course, Phase::Durations, near.config.search, incumbent, tools);
  }
  return reason;
}

bool needs_evasion(const Incumbent& incumbent, const Fallback& fallback) {
  if (incumbent.best() && incumbent.best()->holds) return false;
  return fallback.is_hit_at_rest || !(incumbent.committed() && incumbent.committed()->holds);
}

/// Replaces the best candidate by an evasion, if that stays clear longer than the best and the committed trajectory.
void evade(const Surroundings& near, const Course& course, Incumbent& incumbent, PlanTools& tools) {
  auto found = find_evasion(near, course, Phase::Evasion, tools);
  const double best_s = incumbent.best() ? incumbent.best()->clear_s : 0.0;
  const double committed_s = incumbent.committed() ? incumbent.committed()->clear_s : 0.0;
  if (found && found->clear_s > std::max(best_s, committed_s)) incumbent.replace_best(std::move(found));
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
  Surroundings near = surroundings(request, world, config, workspace);
  blank.relaxed = near.start.relaxed;
  const bool has_arrived = has_reached_goal(request, world.goal->goal, config);
  const Fallback fallback = check_committed(near, has_arrived, tools);
  Incumbent incumbent(near, std::move(blank), fallback.committed, world.predictions->set.confidence, tools);
  if (has_arrived && !needs_evasion(incumbent, fallback)) {
    return {incumbent.committed_plan(PlanReason::AtGoal), log.statistics};
  }
  log.enter(Stage::LocalGoal);
  const auto path = path_to_goal(*world.goal, request.start.p);
  const bool flies_to_goal = path && !path->empty();
  const auto course_at = [&](double radius) { return course_along(*path, world.goal->field->cost(), radius, near); };
  Course course = flies_to_goal ? course_at(kLocalGoalShare * config.sphere_radius_m) : course_in_place(near);
  if (flies_to_goal) incumbent.set_course(course);
  const bool is_among_estimates = flies_to_goal && !has_arrived && !near.hold.none_estimated;
  if (near.start.relaxed && !is_among_estimates) incumbent.replace_best(find_evasion(near, course, Phase::Room, tools));
  const bool has_found_room = incumbent.best().has_value();
  PlanReason reason = path ? PlanReason::None : PlanReason::GoalBlocked;
  if (path && !has_arrived && !has_found_room && !(is_among_estimates && near.start.relaxed))
    reason = try_durations(near, course, Phase::Durations, config.search, incumbent, tools);
  if (is_among_estimates) {
    if (near.start.relaxed) incumbent.replace_committed(std::nullopt, course);
    if (!is_settled(near, course, incumbent)) reason = plan_with_reduced_assurance(course, near, incumbent, tools);
    return {incumbent.choose(incumbent.best() ? PlanReason::None : reason), log.statistics};
  }
  if (flies_to_goal && !has_arrived && !has_found_room && is_at_rest(request))
    reason = try_smaller_steps(near, course_at, course, reason, incumbent, tools);
  if (needs_evasion(incumbent, fallback)) evade(near, course, incumbent, tools);
  return {incumbent.choose(reason), log.statistics};
}

PlanAnswer plan(const HorizonRequest& request, const PlanningWorld& world, const PlannerConfig& config, Budget& budget,
                PlanObserver* observer) {
  PlanWorkspace workspace;
  return plan(request, world, config, budget, workspace, observer);
}

}  // namespace tern
