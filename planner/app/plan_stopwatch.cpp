#include "planner/app/plan_stopwatch.h"

#include <algorithm>

#include "planner/search/semantic_a_star.h"

namespace tern {

void PlanStopwatch::close_stage() {
  const double now_ms = clock_ms_();
  stage_ms_[static_cast<int>(stage_)] += now_ms - stage_started_ms_;
  stage_started_ms_ = now_ms;
}

void PlanStopwatch::enter(Stage stage) {
  close_stage();
  stage_ = stage;
}

void PlanStopwatch::answer(const Plan& best_so_far) {
  const bool is_new = best_so_far.outcome != PlanOutcome::KeepCommitted && best_so_far.outcome != PlanOutcome::NoPlan;
  if (is_new && first_answer_ms_ == 0.0) first_answer_ms_ = clock_ms_() - started_ms_;
  improved_(best_so_far);
}

void PlanStopwatch::searched(const SearchProblem&, SeparationCache&, const SearchResult& result) {
  nodes_ = result.nodes;
}

PlanTiming PlanStopwatch::timing(const PlanAnswer& answer) {
  close_stage();
  PlanTiming timing;
  timing.request_id = answer.plan.request_id;
  timing.total_ms = clock_ms_() - started_ms_;
  timing.first_answer_ms = first_answer_ms_ > 0.0 ? first_answer_ms_ : timing.total_ms;
  timing.cpu_ms = thread_cpu_ms() - cpu_at_start_ms_;
  std::copy_n(stage_ms_, kStages, timing.stage_ms);
  timing.expansions = answer.statistics.expansions;
  timing.hulls = answer.statistics.hulls;
  const PairCounts& pairs = answer.statistics.pairs;
  timing.pairs_by_index = answer.statistics.pairs_by_index;
  timing.pairs_by_box = pairs.by_box;
  timing.pairs_by_instant = pairs.by_instant;
  timing.pairs_by_cache = pairs.by_cache;
  timing.pairs_by_plane = pairs.by_plane;
  timing.solver_calls = answer.statistics.solver_calls;
  timing.solver_iterations = answer.statistics.solver_iterations;
  timing.peak_rss_kb = peak_rss_kb();
  return timing;
}

}  // namespace tern
