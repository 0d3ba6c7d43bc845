#include "planner/less_sure.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "planner/durations.h"
#include "planner/evasion.h"
#include "planner/fallback.h"
#include "planner/plan_workspace.h"
#include "planner/tuning.h"

namespace tern {
namespace {

bool is_at_rest(const Surroundings& near) { return near.request.t_s >= near.request.committed.end(); }

/// By how much of the way to the local goal the candidate gets nearer to it.
double share_of_way(const Surroundings& near, const Heading& heading, const Candidate& candidate) {
  const double to_go = (heading.local.goal - near.request.start.p).norm();
  return to_go > 0.0 ? 1.0 - candidate.cost.distance_to_goal / to_go : 0.0;
}

}  // namespace

bool is_settled(const Surroundings& near, const Heading& heading, const StandingAnswer& standing) {
  const bool holds = standing.best() && standing.best()->holds;
  if (is_at_rest(near)) return holds && share_of_way(near, heading, *standing.best()) >= kGetsOn;
  return holds || (standing.committed() && standing.committed()->holds);
}

PlanReason plan_less_sure(const Heading& heading, Surroundings& near, StandingAnswer& standing, PlanTools& tools) {
  SearchConfig search = near.config.search;
  search.max_expansions = std::min(search.max_expansions, kLessSureExpansions);
  search.hold_expansions = std::min(search.hold_expansions, kLessSureHoldExpansions);
  PlanReason reason = PlanReason::Infeasible;
  const Assurance& last = lower_assurances().back();
  for (const Assurance& less : lower_assurances()) {
    if (is_settled(near, heading, standing)) break;
    if (less.scale < 1.0 && (standing.best() || standing.committed())) break;
    count_less(less, tools.memory, near);
    if (near.start.relaxed && &less != &last) continue;
    if (!standing.committed()) standing.keep(check_committed(near, false, tools).committed, heading);
    reason = try_durations(near, heading, Phase::Evasion, search, standing, tools);
  }
  if (!standing.best() && !standing.committed()) standing.replace(find_evasion(near, heading, Phase::Evasion, tools));
  return reason;
}

}  // namespace tern
