#include "planner/less_sure.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "planner/durations.h"
#include "planner/evasion.h"
#include "planner/fallback.h"
#include "planner/plan_workspace.h"
#include "planner/problem/tuning.h"

namespace tern {
bool is_settled(const Surroundings& near, const Heading& heading, const StandingAnswer& standing) {
  const auto settles = [&](const std::optional<Candidate>& candidate) {
    return candidate && candidate->holds &&
           share_of_way(near.request.start.p, heading.local.goal, candidate->trajectory) >= kSettles;
  };
  return settles(standing.best()) || settles(standing.committed());
}

PlanReason plan_less_sure(const Heading& heading, Surroundings& near, StandingAnswer& standing, PlanTools& tools) {
  SearchConfig search = near.config.search;
  search.max_expansions = std::min(search.max_expansions, kLessSureExpansions);
  search.hold_expansions = std::min(search.hold_expansions, kLessSureHoldExpansions);
  PlanReason reason = PlanReason::Infeasible;
  const std::vector<Assurance> all = lower_assurances(near.hold.aside_s);
  for (const Assurance& less : all) {
    if (is_settled(near, heading, standing)) break;
    if (less.level == 0 && less.sure_for.seconds() >= near.hold.predicted_s) continue;  // that is all there is
    const bool has_waited = rested_s(near.request) > kPatience * (1.0 - confidence_of(less, standing.promised()));
    if (less.scale < 1.0 && (standing.best() || standing.committed()) && !has_waited) break;
    count_less(less, tools.memory, near);
    if (near.start.relaxed && &less != &all.back()) continue;
    if (!standing.committed()) standing.keep(check_committed(near, false, tools).committed, heading);
    const bool may_stay = less.scale == 1.0 && standing.committed() && standing.committed()->holds;
    if (stands_still(near.request) && may_stay && !has_waited) break;
    reason = try_durations(near, heading, Phase::Evasion, search, standing, tools);
  }
  if (!standing.best() && !standing.committed()) standing.replace(find_evasion(near, heading, Phase::Evasion, tools));
  return reason;
}

}  // namespace tern
