#include "planner/incumbent.h"

#include <utility>

#include "planner/problem/tuning.h"

namespace tern {

Incumbent::Incumbent(const Surroundings& near, Plan blank, std::optional<Candidate> committed, double set_confidence,
                     PlanTools& tools)
    : near_(near),
      blank_(std::move(blank)),
      committed_(std::move(committed)),
      set_confidence_(set_confidence),
      tools_(tools) {
  if (PlanObserver* observer = tools_.log.observer()) {
    observer->answer(committed_plan(near.start.collides ? PlanReason::StartInCollision : PlanReason::OutOfTime));
  }
}

void Incumbent::set_course(const Course& course) {
  blank_.local_goal = course.local.goal;
  for (auto* candidate : {&committed_, &best_}) {
    if (*candidate) evaluate(near_, course, **candidate);
  }
}

void Incumbent::replace_committed(std::optional<Candidate> committed, const Course& course) {
  committed_ = std::move(committed);
  if (committed_) evaluate(near_, course, *committed_);
}

void Incumbent::report_leaf(const Candidate& leaf) {
  if (is_better_than_best(leaf)) report(leaf);
}

void Incumbent::offer(Candidate candidate) {
  if (is_better_than_best(candidate)) replace_best(std::move(candidate));
}

void Incumbent::replace_best(std::optional<Candidate> evasion) {
  if (!evasion) return;
  best_ = std::move(evasion);
  report(*best_);
}

void Incumbent::report(const Candidate& candidate) {
  PlanObserver* observer = tools_.log.observer();
  if (observer == nullptr || is_worse_than_committed(candidate)) return;
  observer->answer(filled(&candidate, PlanReason::None));
}

Plan Incumbent::choose(PlanReason reason) const {
  if (!best_) return committed_plan(!committed_ && reason == PlanReason::None ? PlanReason::Infeasible : reason);
  const bool stays = best_->outcome != PlanOutcome::Evade && is_worse_than_committed(*best_) && !departs_from_rest();
  return stays ? committed_plan(PlanReason::WorsePlan) : filled(&*best_, PlanReason::None);
}

/// If neither end holds, the candidate that stays clear for less time is worse: it leaves less time to step aside.
/// Among estimates the arrival decides instead, because their far future is hardly known.
bool Incumbent::is_worse_than_committed(const Candidate& candidate) const {
  if (!committed_) return false;
  const bool neither_holds = !candidate.holds && !committed_->holds;
  if (near_.hold.none_estimated && neither_holds && candidate.clear_s < committed_->clear_s) return true;
  return is_delayed(candidate) || !candidate.is_preferred_to(*committed_);
}

bool Incumbent::makes_progress(const Candidate& candidate) const {
  return progress_share(near_.request.start.p, blank_.local_goal, candidate.trajectory) > kMinProgress;
}

/// At rest, of two candidates with equal holds, the one that makes progress is better, whatever the estimated arrivals
/// are. Otherwise is_preferred_to() decides.
bool Incumbent::is_better_than_best(const Candidate& candidate) const {
  if (!best_) return true;
  const bool leads = makes_progress(candidate);
  if (is_at_rest(near_.request) && candidate.holds == best_->holds && leads != makes_progress(*best_)) return leads;
  return candidate.is_preferred_to(*best_);
}

/// Returns true if the committed trajectory makes progress and the candidate does not. From rest it also returns true
/// if both end at the same point and the candidate later. Such a candidate is faster half-way, so its arrival is
/// estimated as earlier. If it replaced the committed trajectory, the departure would be delayed at every request.
bool Incumbent::is_delayed(const Candidate& candidate) const {
  if (candidate.holds != committed_->holds) return false;
  if (makes_progress(*committed_) && !makes_progress(candidate)) return true;
  const TimedSpline& kept = committed_->trajectory;
  if (!is_stationary(near_.request) || candidate.trajectory.end() < kept.end()) return false;
  const Vec3 apart = candidate.trajectory.control_points.rightCols<1>() - kept.control_points.rightCols<1>();
  return apart.norm() < kMinApproach;
}

/// At rest, a candidate that ends nearer to the goal is flown if it arrives at most kMaxArrivalLoss later than staying.
/// After kMaxWaitAtRest it is flown whatever its arrival. Arrivals are counted per axis: a plan that begins gently, or
/// strays on a slow axis, may arrive no earlier than staying does.
bool Incumbent::departs_from_rest() const {
  if (!is_at_rest(near_.request) || best_->holds != committed_->holds) return false;
  if (time_at_rest_s(near_.request) <= kMaxWaitAtRest && best_->arrival_s > committed_->arrival_s + kMaxArrivalLoss)
    return false;
  return best_->cost.distance_to_goal < (blank_.local_goal - near_.request.start.p).norm() - kMinApproach;
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
  plan.confidence = confidence_of(candidate->assurance, set_confidence_);
  plan.trajectory = candidate->trajectory;
  plan.hold = Duration::from_seconds(candidate->hold_s);
  plan.cost = candidate->cost;
  plan.certificate = candidate->certificate;
  return plan;
}

}  // namespace tern
