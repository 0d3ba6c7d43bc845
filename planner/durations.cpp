#include "planner/durations.h"

#include <optional>
#include <utility>

#include "planner/attempt.h"
#include "planner/plan_workspace.h"
#include "planner/problem/tuning.h"
#include "planner/refinement.h"

namespace tern {
namespace {

PlanReason reason_of_nothing(const Surroundings& near, const Budget& budget) {
  if (near.start.collides) return PlanReason::StartInCollision;
  return budget.cuts().empty() ? PlanReason::Infeasible : PlanReason::OutOfTime;
}

/// Whether a longer duration need not be tried.
bool is_enough(const Surroundings& near, const Heading& heading, const StandingAnswer& standing, Budget& budget) {
  const std::optional<Candidate>& best = standing.best();
  if (!best) return false;
  const bool arrives = best->holds && best->cost.distance_to_goal <= kNearLocalGoal * step_scale(heading.local.radius);
  const bool stays = is_at_rest(near.request) && !standing.gets_on();
  return (arrives && !stays) || budget.expired(Stage::LocalGoal);
}

}  // namespace

PlanReason try_durations(const Surroundings& near, const Heading& heading, Phase phase, const SearchConfig& search,
                         StandingAnswer& standing, PlanTools& tools) {
  const PlannerConfig& config = near.config;
  const SearchConfig lengths = scaled(search, heading.local.radius, heading.local.least_s);
  for (const double scale : config.duration_scales) {
    if (!tools.budget.begin_attempt(phase)) break;
    if (is_enough(near, heading, standing, tools.budget)) break;
    const std::optional<Duration> interval = interval_of(scale * heading.local.least_s, config.intervals);
    if (!interval) break;
    const double end_s = interval->seconds() * config.intervals;
    const Attempt now{near, heading, horizon_problem(near, *interval), near.hold.cap(end_s), near.hold.required(end_s)};
    if (!is_followed(near, *interval, now.hold_s)) break;
    tools.log.enter(Stage::BroadPhase);
    SweptObstacles& swept = tools.memory.horizon;
    sweep_horizon(now, tools.memory.times, swept);
    if (auto leaf = search_candidate(now, lengths, swept, tools)) {
      standing.announce(*leaf);
      standing.take(refined(now, std::move(*leaf), swept, tools));
    }
    tools.log.statistics.count(swept);
  }
  return standing.best() ? PlanReason::None : reason_of_nothing(near, tools.budget);
}

}  // namespace tern
