#include "tools/replay/replan.h"

#include <utility>
#include <vector>

#include "planner/app/answer_desk.h"

namespace tern {
namespace {

/// The cut that says that the watchdog answered, and with which improvement.
const BudgetCut* watchdog_cut(const Plan& plan) {
  const bool is_last = !plan.cuts.empty() && plan.cuts.back().attempt == -1;
  return is_last ? &plan.cuts.back() : nullptr;
}

/// Keeps the k-th answer that stands.
class KthAnswer final : public PlanObserver {
 public:
  explicit KthAnswer(std::int64_t k) : k_(k) {}
  void enter(Stage) override {}
  void answer(const Plan& best_so_far) override {
    if (seen_++ < k_) kept_ = best_so_far;
  }
  Plan take() { return std::move(kept_); }

 private:
  std::int64_t k_, seen_ = 0;
  Plan kept_;
};

Plan as_watchdog(const PlanProblem& problem, const BudgetCut& cut, std::vector<BudgetCut> before) {
  if (cut.count == 0) return unanswered(problem.request);
  KthAnswer observer(cut.count);
  Budget recorded = Budget::replay(std::move(before));
  plan(problem.request, problem.world, problem.config, recorded, &observer);
  return observer.take();
}

}  // namespace

Replanned replan(const PlanProblem& problem, const Plan& recorded) {
  Replanned again;
  std::vector<BudgetCut> cuts = recorded.cuts;
  if (const BudgetCut* cut = watchdog_cut(recorded)) {
    cuts.pop_back();
    again.plan = as_watchdog(problem, *cut, std::move(cuts));
    again.plan.cuts.push_back(*cut);
  } else {
    Budget budget = Budget::replay(std::move(cuts));
    PlanAnswer answer = plan(problem.request, problem.world, problem.config, budget);
    again.plan = std::move(answer.plan);
    again.statistics = answer.statistics;
  }
  again.plan.header = recorded.header;
  again.plan.inputs.configuration_hash = recorded.inputs.configuration_hash;
  again.plan.inputs.planner_build = recorded.inputs.planner_build;
  return again;
}

}  // namespace tern
