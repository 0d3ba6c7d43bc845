#include "planner/planner.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/world/body.h"
#include "planner/durations.h"
#include "planner/evasion.h"
#include "planner/fallback.h"
#include "planner/less_sure.h"
#include "planner/plan_workspace.h"
#include "planner/problem/tuning.h"
#include "planner/standing_answer.h"

namespace tern {
namespace {

/// What every answer to the request says.
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

/// At rest where it shall be: nothing to do but to stay clear.
bool rests_where_it_shall(const HorizonRequest& request, const Goal& goal, const PlannerConfig& config) {
  if (!is_at_rest(request)) return false;
  return goal.mode != GoalMode::Go || (request.start.p - goal.position).norm() <= config.goal_tolerance_m;
}

/// The path around static obstacles. @return nullopt if there is none; empty for who shall hold or stop
std::optional<std::vector<Vec3>> path_to_goal(const GoalProducts& goal, const Vec3& from) {
  if (goal.goal.mode != GoalMode::Go) return std::vector<Vec3>{};
  return goal.field->path_from(from);
}

/// Smaller and smaller steps, while nothing gets on. @param head  heads along the path, to a local goal so far away
/// @param reason  why nothing was found so far @return why there is nothing
PlanReason creep(const Surroundings& near, const auto& head, Heading& heading, PlanReason reason,
                 StandingAnswer& standing, PlanTools& tools) {
  for (int k = 0; k < kSmallerSteps && !standing.gets_on(); ++k) {
    if (tools.budget.expired(Stage::LocalGoal)) break;
    const double step = std::min(heading.local.radius, (heading.local.goal - near.request.start.p).norm());
    heading = step_along(head(step / kSmallerStep));
    standing.head_for(heading);
    reason = try_durations(near, heading, Phase::Durations, near.config.search, standing, tools);
  }
  return reason;
}

bool needs_evasion(const StandingAnswer& standing, const Fallback& fallback) {
  if (standing.best() && standing.best()->holds) return false;
  return fallback.is_hit_at_rest || !(standing.committed() && standing.committed()->holds);
}

/// The reachable stop that stays clear longest, if that is longer than what stands.
void evade(const Surroundings& near, const Heading& heading, StandingAnswer& standing, PlanTools& tools) {
  auto found = find_evasion(near, heading, Phase::Evasion, tools);
  const double best_s = standing.best() ? standing.best()->clear_s : 0.0;
  const double committed_s = standing.committed() ? standing.committed()->clear_s : 0.0;
  if (found && found->clear_s > std::max(best_s, committed_s)) standing.replace(std::move(found));
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
  const bool rests = rests_where_it_shall(request, world.goal->goal, config);
  const Fallback fallback = check_committed(near, rests, tools);
  StandingAnswer standing(near, std::move(blank), fallback.committed, world.predictions->set.confidence, tools);
  if (rests && !needs_evasion(standing, fallback)) {
    return {standing.kept(PlanReason::AtGoal), log.statistics};
  }
  log.enter(Stage::LocalGoal);
  const auto path = path_to_goal(*world.goal, request.start.p);
  const bool goes = path && !path->empty();
  const auto head = [&](double radius) { return heading_along(*path, world.goal->field->cost(), radius, near); };
  Heading heading = goes ? head(kLocalGoalShare * config.sphere_radius_m) : heading_nowhere(near);
  if (goes) standing.head_for(heading);
  const bool has_less = goes && !rests && !near.hold.promised;
  if (near.start.relaxed && !has_less) standing.replace(find_evasion(near, heading, Phase::Room, tools));
  const bool makes_room = standing.best().has_value();
  PlanReason reason = path ? PlanReason::None : PlanReason::GoalBlocked;
  if (path && !rests && !makes_room && !(has_less && near.start.relaxed))
    reason = try_durations(near, heading, Phase::Durations, config.search, standing, tools);
  if (has_less) {
    if (near.start.relaxed) standing.keep(std::nullopt, heading);
    if (!is_settled(near, heading, standing)) reason = plan_less_sure(heading, near, standing, tools);
    return {standing.chosen(standing.best() ? PlanReason::None : reason), log.statistics};
  }
  if (goes && !rests && !makes_room && is_at_rest(request))
    reason = creep(near, head, heading, reason, standing, tools);
  if (needs_evasion(standing, fallback)) evade(near, heading, standing, tools);
  return {standing.chosen(reason), log.statistics};
}

PlanAnswer plan(const HorizonRequest& request, const PlanningWorld& world, const PlannerConfig& config, Budget& budget,
                PlanObserver* observer) {
  PlanWorkspace workspace;
  return plan(request, world, config, budget, workspace, observer);
}

}  // namespace tern
