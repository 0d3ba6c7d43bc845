#include "tools/replay/replan.h"

#include <utility>
#include <vector>

#include "planner/app/answer_desk.h"
#include "planner/app/heading_desk.h"

namespace tern {
namespace {

/// Keeps the k-th improvement.
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

Plan as_watchdog(const PlanProblem& problem, const Plan& recorded) {
  if (*recorded.standing == 0) return unanswered(problem.request);
  KthAnswer observer(*recorded.standing);
  Budget budget = Budget::replay(recorded.cuts);
  plan(problem.request, problem.world, problem.config, budget, &observer);
  return observer.take();
}

}  // namespace

Replanned replan(const PlanProblem& problem, const Plan& recorded) {
  Replanned again;
  if (recorded.standing) {
    again.plan = as_watchdog(problem, recorded);
    again.plan.standing = recorded.standing;
  } else {
    Budget budget = Budget::replay(recorded.cuts);
    PlanAnswer answer = plan(problem.request, problem.world, problem.config, budget);
    again.plan = std::move(answer.plan);
    again.statistics = answer.statistics;
  }
  again.plan.header = recorded.header;
  again.plan.inputs.configuration_hash = recorded.inputs.configuration_hash;
  again.plan.inputs.planner_build = recorded.inputs.planner_build;
  return again;
}

std::optional<PlanHeading> replan_heading(const PlanProblem& problem, const Plan& plan, const PlanHeading& recorded) {
  auto again = plan_heading_in(problem.world, problem.request, plan, problem.config, problem.heading,
                               {recorded.control_points[0], recorded.control_points[1]});
  if (again) again->header = recorded.header;
  return again;
}

}  // namespace tern
