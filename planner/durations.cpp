#include "planner/durations.h"

#include <iterator>
#include <utility>

#include "planner/attempt.h"
#include "planner/plan_workspace.h"
#include "planner/refinement.h"
#include "planner/stop_rule.h"

namespace tern {
namespace {

PlanReason reason_of_nothing(const Surroundings& near, const Budget& budget) {
  if (near.start.collides) return PlanReason::StartInCollision;
  return budget.cuts().empty() ? PlanReason::Infeasible : PlanReason::OutOfTime;
}

}  // namespace

PlanReason try_durations(const Surroundings& near, const Course& course, const Trial& trial, Incumbent& incumbent,
                         PlanTools& tools) {
  const PlannerConfig& config = near.config;
  const SearchConfig search =
      scaled(effort_of(trial.effort, config.search), course.local.radius, course.local.planned_s);
  for (int k = 0; k < static_cast<int>(std::ssize(config.duration_scales)); ++k) {
    if (trial.duration && k != *trial.duration) continue;
    if (!tools.budget.begin_attempt(trial.phase) || is_long_enough(incumbent, course, near)) break;
    if (incumbent.best() && tools.budget.expired(Stage::LocalGoal)) break;
    const auto attempt = attempt_of(near, course, config.duration_scales[idx(k)] * course.local.planned_s);
    if (!attempt) break;
    tools.log.enter(Stage::BroadPhase);
    SeparationCache& swept = sweep_horizon(*attempt, tools.memory.times, tools.memory.horizon);
    if (auto leaf = search_candidate(*attempt, search, swept, tools)) {
      incumbent.report_leaf(*leaf);
      incumbent.offer(refined(*attempt, std::move(*leaf), swept, tools));
    }
    tools.log.statistics.count(swept);
  }
  return incumbent.best() ? PlanReason::None : reason_of_nothing(near, tools.budget);
}

}  // namespace tern
