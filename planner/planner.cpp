#include "planner/planner.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/world/body.h"
#include "planner/attempt.h"
#include "planner/evasion.h"
#include "planner/fallback.h"
#include "planner/plan_workspace.h"
#include "planner/refinement.h"
#include "planner/standing_answer.h"
#include "planner/tuning.h"

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

bool is_at_rest(const HorizonRequest& request) { return request.t_s >= request.committed.end(); }

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

PlanReason reason_of_nothing(const Surroundings& near, const Budget& budget) {
  if (near.start.collides) return PlanReason::StartInCollision;
  return budget.cuts().empty() ? PlanReason::Infeasible : PlanReason::OutOfTime;
}

/// Whether a longer duration need not be tried.
bool is_enough(const std::optional<Candidate>& best, const Heading& heading, Budget& budget) {
  if (!best) return false;
  const double near = kNearLocalGoal * step_scale(heading.local.radius);
  return (best->holds && best->cost.distance_to_goal <= near) || budget.expired(Stage::LocalGoal);
}

/// Too short a duration leaves the goal out of reach, too long a one is slow: a few scales of the least one, each leaf
/// optimized, the best kept. @return why there is no plan
PlanReason try_durations(const Surroundings& near, const Heading& heading, StandingAnswer& standing, PlanTools& tools) {
  const PlannerConfig& config = near.config;
  const SearchConfig search = scaled(config.search, heading.local.radius, heading.local.least_s);
  for (const double scale : config.duration_scales) {
    if (!tools.budget.begin_attempt(Phase::Durations)) break;
    if (is_enough(standing.best(), heading, tools.budget)) break;
    const std::optional<Duration> interval = interval_of(scale * heading.local.least_s, config.intervals);
    if (!interval) break;
    const double end_s = interval->seconds() * config.intervals;
    const Attempt now{near, heading, horizon_problem(near, *interval), near.hold.cap(end_s), near.hold.required(end_s)};
    if (!is_followed(near, *interval, now.hold_s)) break;
    tools.log.enter(Stage::Hulls);
    SweptObstacles& swept = tools.memory.horizon;
    sweep_horizon(now, tools.memory.times, swept);
    if (auto leaf = search_candidate(now, search, swept, tools)) {
      standing.announce(*leaf);
      standing.take(refined(now, std::move(*leaf), swept, tools));
    }
    tools.log.statistics.count(swept);
  }
  return standing.best() ? PlanReason::None : reason_of_nothing(near, tools.budget);
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
  const Surroundings near = surroundings(request, world, config, workspace);
  blank.relaxed = near.start.relaxed;
  const bool rests = rests_where_it_shall(request, world.goal->goal, config);
  const Fallback fallback = check_committed(near, rests, tools);
  StandingAnswer standing(near, std::move(blank), fallback.committed, tools);
  if (rests && !needs_evasion(standing, fallback)) {
    return {standing.kept(PlanReason::AtGoal), log.statistics};
  }
  log.enter(Stage::LocalGoal);
  const auto path = path_to_goal(*world.goal, request.start.p);
  const bool goes = path && !path->empty();
  const auto head = [&](double radius) {
    const Heading ahead = heading_along(*path, world.goal->field->cost(), radius, near);
    standing.head_for(ahead);
    return ahead;
  };
  Heading heading = goes ? head(kLocalGoalShare * config.sphere_radius_m) : heading_nowhere(near);
  if (near.start.relaxed) standing.replace(find_evasion(near, heading, Phase::Room, tools));
  PlanReason reason = path ? PlanReason::None : PlanReason::GoalBlocked;
  if (path && !rests && !standing.best()) reason = try_durations(near, heading, standing, tools);
  const bool may_creep = goes && !rests && is_at_rest(request);
  for (int k = 0; may_creep && k < kSmallerSteps && !standing.best() && !budget.expired(Stage::LocalGoal); ++k) {
    heading = head(heading.local.radius / kSmallerStep);
    reason = try_durations(near, heading, standing, tools);
  }
  if (needs_evasion(standing, fallback)) evade(near, heading, standing, tools);
  return {standing.chosen(reason), log.statistics};
}

PlanAnswer plan(const HorizonRequest& request, const PlanningWorld& world, const PlannerConfig& config, Budget& budget,
                PlanObserver* observer) {
  PlanWorkspace workspace;
  return plan(request, world, config, budget, workspace, observer);
}

}  // namespace tern
