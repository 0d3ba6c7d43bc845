#include "planner/preference.h"

#include "planner/problem/tuning.h"

namespace tern {
namespace {

/// Compares by `holds` first, then by the earlier arrival.
bool holds_or_arrives_earlier(const Candidate& a, const Candidate& b) {
  if (a.holds != b.holds) return a.holds;
  return a.arrival_s < b.arrival_s;
}

bool ends_where(const Candidate& candidate, const Candidate& other) {
  const Vec3 apart =
      candidate.trajectory.control_points.rightCols<1>() - other.trajectory.control_points.rightCols<1>();
  return apart.norm() < kMinApproach;
}

bool departs_from_rest(const Candidate& candidate, const Candidate& committed, const Surroundings& near) {
  if (!is_at_rest(near.request) || candidate.holds != committed.holds || !candidate.approaches) return false;
  if (candidate.contact_s < committed.contact_s) return false;
  return time_at_rest_s(near.request) > kMaxWaitAtRest || candidate.arrival_s <= committed.arrival_s + kMaxArrivalLoss;
}

/// Returns the decrease of the cost-to-go from start to end, m.
double approach_of(const Candidate& candidate, const Attempt& attempt) {
  const CostToGo& cost_to_go = attempt.course.cost_to_go;
  return cost_to_go.from(attempt.problem.start.p) - cost_to_go.from(candidate.trajectory.control_points.rightCols<1>());
}

}  // namespace

bool makes_progress(const Candidate& candidate) { return candidate.progress > kMinProgress; }

bool is_better(const Candidate& candidate, const Candidate& best, const Surroundings& near) {
  if (candidate.contact_s != best.contact_s) return candidate.contact_s > best.contact_s;
  const bool leads = makes_progress(candidate);
  if (is_at_rest(near.request) && candidate.holds == best.holds && leads != makes_progress(best)) return leads;
  return holds_or_arrives_earlier(candidate, best);
}

bool is_worse_than_committed(const Candidate& candidate, const Candidate& committed, const Surroundings& near) {
  if (candidate.contact_s != committed.contact_s) return candidate.contact_s < committed.contact_s;
  if (!holds_or_arrives_earlier(candidate, committed)) return true;
  if (candidate.holds != committed.holds) return false;
  if (!near.hold.has_estimated && !candidate.holds && candidate.clear_s < committed.clear_s) return true;
  if (makes_progress(committed) && !makes_progress(candidate)) return true;
  const bool ends_later = candidate.trajectory.end() >= committed.trajectory.end();
  return is_stationary(near.request) && ends_later && ends_where(candidate, committed);
}

bool replaces_committed(const Candidate& candidate, const Candidate& committed, const Surroundings& near) {
  if (candidate.outcome == PlanOutcome::Evade) return true;
  return !is_worse_than_committed(candidate, committed, near) || departs_from_rest(candidate, committed, near);
}

bool replaces_leaf(const Candidate& optimized, const Candidate& leaf, const Attempt& attempt) {
  if (optimized.contact_s < leaf.contact_s || (leaf.holds && !optimized.holds)) return false;
  const double approach = approach_of(leaf, attempt);
  const bool is_short = attempt.problem.interval < kShortInterval;
  if (is_short && approach > 0.0 && approach_of(optimized, attempt) < kMinProgressKept * approach) return false;
  return optimized.arrival_s <= leaf.arrival_s + kMaxArrivalLoss;
}

bool is_better_stop(const Candidate& stop, const Candidate& best, Aim aim) {
  return aim == Aim::Room ? stop.room > best.room : stop.clear_s > best.clear_s;
}

}  // namespace tern
