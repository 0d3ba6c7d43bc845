#include "planner/reduced_assurance.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "planner/durations.h"
#include "planner/evasion.h"
#include "planner/fallback.h"
#include "planner/plan_workspace.h"
#include "planner/problem/tuning.h"

namespace tern {
bool is_settled(const Surroundings& near, const Course& course, const Incumbent& incumbent) {
  const auto settles = [&](const std::optional<Candidate>& candidate) {
    return candidate && candidate->holds &&
           progress_share(near.request.start.p, course.local.goal, candidate->trajectory) >= kMinSettledProgress;
  };
  return settles(incumbent.best()) || settles(incumbent.committed());
}

PlanReason plan_with_reduced_assurance(const Course& course, Surroundings& near, Incumbent& incumbent,
                                       PlanTools& tools) {
  SearchConfig search = near.config.search;
  search.max_expansions = std::min(search.max_expansions, kReducedExpansions);
  search.hold_expansions = std::min(search.hold_expansions, kReducedHoldExpansions);
  PlanReason reason = PlanReason::Infeasible;
  const std::vector<Assurance> all = reduced_assurances(near.hold.side_step_s);
  for (const Assurance& reduced : all) {
    if (is_settled(near, course, incumbent)) break;
    if (reduced.level == 0 && reduced.sure_for.seconds() >= near.hold.predicted_s)
      continue;  // the same as the full assurance
    const bool has_waited =
        time_at_rest_s(near.request) > kMaxWaitAtRest * (1.0 - confidence_of(reduced, incumbent.set_confidence()));
    if (reduced.scale < 1.0 && (incumbent.best() || incumbent.committed()) && !has_waited) break;
    reduce_assurance(reduced, tools.memory, near);
    if (near.start.relaxed && &reduced != &all.back()) continue;
    if (!incumbent.committed()) incumbent.replace_committed(check_committed(near, false, tools).committed, course);
    const bool may_stay = reduced.scale == 1.0 && incumbent.committed() && incumbent.committed()->holds;
    if (is_stationary(near.request) && may_stay && !has_waited) break;
    reason = try_durations(near, course, Phase::Evasion, search, incumbent, tools);
  }
  if (!incumbent.best() && !incumbent.committed())
    incumbent.replace_best(find_evasion(near, course, Phase::Evasion, tools));
  return reason;
}

}  // namespace tern
