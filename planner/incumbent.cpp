#include "planner/incumbent.h"

#include <utility>

#include "planner/preference.h"

namespace tern {

Incumbent::Incumbent(const Surroundings& near, Plan blank, std::optional<Candidate> committed, PlanTools& tools)
    : near_(near), blank_(std::move(blank)), committed_(std::move(committed)), tools_(tools) {
  report(best_);
}

void Incumbent::set_course(const Course& course) {
  blank_.local_goal = course.local.goal;
  for (auto* candidate : {&committed_, &best_}) {
    if (*candidate) evaluate(near_, course, **candidate);
  }
  report(best_);
}

void Incumbent::replace_committed(std::optional<Candidate> committed, const Course& course) {
  committed_ = std::move(committed);
  if (committed_) evaluate(near_, course, *committed_);
  report(best_);
}

void Incumbent::report_leaf(const Candidate& leaf) {
  if (!beats_best(leaf)) return;
  report(leaf);
  leaf_stands_ = true;
}

void Incumbent::offer(Candidate candidate) {
  const bool is_best = beats_best(candidate);
  if (is_best) best_ = std::move(candidate);
  if (is_best || leaf_stands_) report(best_);
}

void Incumbent::offer_stop(std::optional<Candidate> stop, Aim aim) {
  if (!stop) return;
  const auto beats = [&](const std::optional<Candidate>& other) {
    return !other || is_better_stop(*stop, *other, aim);
  };
  if (aim != Aim::Room && !(beats(best_) && beats(committed_))) return;
  best_ = std::move(stop);
  report(best_);
}

bool Incumbent::beats_best(const Candidate& candidate) const { return !best_ || is_better(candidate, *best_, near_); }

void Incumbent::report(const std::optional<Candidate>& best) {
  PlanObserver* observer = tools_.log.observer();
  leaf_stands_ = false;
  if (observer == nullptr) return;
  observer->answer(answer_with(best, near_.start.collides ? PlanReason::StartInCollision : PlanReason::OutOfTime));
}

Plan Incumbent::answer(PlanReason reason) const { return answer_with(best_, reason); }

Plan Incumbent::answer_with(const std::optional<Candidate>& best, PlanReason reason) const {
  if (best && (!committed_ || replaces_committed(*best, *committed_, near_))) {
    return filled(&*best, PlanReason::None);
  }
  if (best) return filled(&*committed_, PlanReason::WorsePlan);
  if (committed_) return filled(&*committed_, reason);
  return filled(nullptr, reason == PlanReason::None ? PlanReason::Infeasible : reason);
}

Plan Incumbent::filled(const Candidate* candidate, PlanReason reason) const {
  Plan plan = blank_;
  plan.reason = reason;
  plan.cuts = tools_.budget.cuts();
  if (candidate == nullptr) return plan;
  plan.outcome = candidate->outcome;
  plan.relaxed = candidate->relaxed;
  plan.level = candidate->assurance.level;
  plan.alpha_scale = candidate->assurance.scale;
  plan.sure_for = candidate->assurance.sure_for;
  plan.confidence = confidence_of(candidate->assurance, near_.set_confidence);
  plan.trajectory = candidate->trajectory;
  plan.hold = Duration::from_seconds(candidate->hold_s);
  plan.cost = candidate->cost;
  plan.certificate = candidate->certificate;
  return plan;
}

}  // namespace tern
