#include "planner/standing_answer.h"

#include <utility>

#include "planner/problem/tuning.h"

namespace tern {

StandingAnswer::StandingAnswer(const Surroundings& near, Plan blank, std::optional<Candidate> committed,
                               double promised, PlanTools& tools)
    : near_(near), blank_(std::move(blank)), committed_(std::move(committed)), promised_(promised), tools_(tools) {
  if (PlanObserver* observer = tools_.log.observer()) {
    observer->answer(kept(near.start.collides ? PlanReason::StartInCollision : PlanReason::OutOfTime));
  }
}

void StandingAnswer::head_for(const Heading& heading) {
  blank_.local_goal = heading.local.goal;
  for (auto* standing : {&committed_, &best_}) {
    if (*standing) weigh(near_, heading, **standing);
  }
}

void StandingAnswer::keep(std::optional<Candidate> committed, const Heading& heading) {
  committed_ = std::move(committed);
  if (committed_) weigh(near_, heading, *committed_);
}

void StandingAnswer::announce(const Candidate& leaf) {
  if (is_best(leaf)) tell(leaf);
}

void StandingAnswer::take(Candidate candidate) {
  if (is_best(candidate)) replace(std::move(candidate));
}

void StandingAnswer::replace(std::optional<Candidate> evasion) {
  if (!evasion) return;
  best_ = std::move(evasion);
  tell(*best_);
}

void StandingAnswer::tell(const Candidate& candidate) {
  PlanObserver* observer = tools_.log.observer();
  if (observer == nullptr || is_worse(candidate)) return;
  observer->answer(filled(&candidate, PlanReason::None));
}

Plan StandingAnswer::chosen(PlanReason reason) const {
  if (!best_) return kept(!committed_ && reason == PlanReason::None ? PlanReason::Infeasible : reason);
  const bool stays = best_->outcome != PlanOutcome::Evade && is_worse(*best_) && !sets_out();
  return stays ? kept(PlanReason::WorsePlan) : filled(&*best_, PlanReason::None);
}

/// Of two ends that do not hold, the one that stays clear longer leaves more time to step aside. (Of estimates the
/// farther future is known worse: there it is the arrival that counts.)
bool StandingAnswer::is_worse(const Candidate& candidate) const {
  if (!committed_) return false;
  const bool neither_holds = !candidate.holds && !committed_->holds;
  if (near_.hold.promised && neither_holds && candidate.clear_s < committed_->clear_s) return true;
  return puts_off(candidate) || !candidate.better_than(*committed_);
}

bool StandingAnswer::gets_on(const Candidate& candidate) const {
  return share_of_way(near_.request.start.p, blank_.local_goal, candidate.trajectory) > kGetsOn;
}

/// To stay at rest is no way to arrive, however early it is estimated to.
bool StandingAnswer::is_best(const Candidate& candidate) const {
  if (!best_) return true;
  const bool leads = gets_on(candidate);
  if (is_at_rest(near_.request) && candidate.holds == best_->holds && leads != gets_on(*best_)) return leads;
  return candidate.better_than(*best_);
}

/// What leads nowhere while the committed one leads on; from rest, also what ends where that does, but later.
/// (Half-way, a later one is faster, and its arrival is estimated as earlier. If it were flown for that, it would be
/// put off again at the next request, for ever.)
bool StandingAnswer::puts_off(const Candidate& candidate) const {
  if (candidate.holds != committed_->holds) return false;
  if (gets_on(*committed_) && !gets_on(candidate)) return true;
  const TimedSpline& now = committed_->trajectory;
  if (!stands_still(near_.request) || candidate.trajectory.end() < now.end()) return false;
  const Vec3 apart = candidate.trajectory.control_points.rightCols<1>() - now.control_points.rightCols<1>();
  return apart.norm() < kNearer;
}

/// A vehicle at rest gains nothing by waiting: a plan that gets nearer is flown even if it arrives as late, or later by
/// kSmoothnessPrice. Who has waited flies it whenever it arrives. (Arrivals are counted per axis. Where one axis is
/// slow, those of rest and of a plan that begins gently are equal. A plan that strays on that axis arrives later.)
bool StandingAnswer::sets_out() const {
  if (!is_at_rest(near_.request) || best_->holds != committed_->holds) return false;
  if (rested_s(near_.request) <= kPatience && best_->arrival_s > committed_->arrival_s + kSmoothnessPrice) return false;
  return best_->cost.distance_to_goal < (blank_.local_goal - near_.request.start.p).norm() - kNearer;
}

Plan StandingAnswer::filled(const Candidate* candidate, PlanReason reason) const {
  Plan plan = blank_;
  plan.reason = reason;
  plan.cuts = tools_.budget.cuts();
  if (candidate == nullptr) return plan;
  plan.outcome = candidate->outcome;
  plan.relaxed = candidate->relaxed;
  plan.level = candidate->assurance.level;
  plan.alpha_scale = candidate->assurance.scale;
  plan.sure_for = candidate->assurance.sure_for;
  plan.confidence = confidence_of(candidate->assurance, promised_);
  plan.trajectory = candidate->trajectory;
  plan.hold = Duration::from_seconds(candidate->hold_s);
  plan.cost = candidate->cost;
  plan.certificate = candidate->certificate;
  return plan;
}

}  // namespace tern
