#include "tools/replay/plan_difference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/world/names.h"
#include "messages/codec.h"

namespace tern {
namespace {

std::string text(const Vec3& v) { return fmt::format("({:.9g}, {:.9g}, {:.9g})", v.x(), v.y(), v.z()); }

std::string text(const BudgetCut& cut) {
  return fmt::format("{} {}, {}, after {}", to_string(cut.phase), cut.attempt, to_string(cut.stage), cut.count);
}

/// Returns the largest distance between the trajectories at equal times. With equal knots it is taken at control
/// points, a bound by the convex hull; otherwise at closely spaced times.
double distance_between(const TimedSpline& a, const TimedSpline& b) {
  const bool same_knots =
      a.start == b.start && a.interval == b.interval && a.control_points.cols() == b.control_points.cols();
  if (same_knots) return (a.control_points - b.control_points).colwise().norm().maxCoeff();
  constexpr Duration kStep{5'000};
  double largest = 0.0;
  for (UTime t = std::max(a.start, b.start); t <= std::max(a.end(), b.end()); t = t + kStep) {
    largest = std::max(largest, (a.sample(std::min(t, a.end())).p - b.sample(std::min(t, b.end())).p).norm());
  }
  return largest;
}

/// Collects the differences.
class Comparison {
 public:
  Comparison(const Plan& recorded, const Plan& again, const PlanTiming* recorded_work, const PlanStatistics* work)
      : a_(recorded), b_(again), a_work_(recorded_work), b_work_(work) {}

  std::vector<PartDifference> run() {
    compare_cuts();
    compare_standing();
    note_numbers(Stage::BroadPhase, "relaxed", static_cast<int>(a_.relaxed), static_cast<int>(b_.relaxed));
    note_numbers(Stage::BroadPhase, "level", a_.level, b_.level);
    note_numbers(Stage::BroadPhase, "share of alpha", a_.alpha_scale, b_.alpha_scale);
    note_numbers(Stage::BroadPhase, "sure for, µs", a_.sure_for.us, b_.sure_for.us);
    if (a_.local_goal != b_.local_goal) {
      add(Stage::LocalGoal, fmt::format("local goal: {}, now {}", text(a_.local_goal), text(b_.local_goal)));
    }
    compare_work();
    compare_trajectories();
    note_numbers(Stage::Check, "hold, µs", a_.hold.us, b_.hold.us);
    compare_certificates();
    compare_costs();
    compare_outcomes();
    std::stable_sort(parts_.begin(), parts_.end(),
                     [](const PartDifference& x, const PartDifference& y) { return x.stage < y.stage; });
    return std::move(parts_);
  }

 private:
  void add(Stage stage, std::string what) { parts_.push_back({stage, std::move(what)}); }
  template <class T>
  void note_numbers(Stage stage, const char* what, T a, T b) {
    if (a != b) add(stage, fmt::format("{}: {}, now {}", what, a, b));
  }

  void compare_cuts() {
    for (std::size_t k = 0; k < std::max(a_.cuts.size(), b_.cuts.size()); ++k) {
      const BudgetCut* a = k < a_.cuts.size() ? &a_.cuts[k] : nullptr;
      const BudgetCut* b = k < b_.cuts.size() ? &b_.cuts[k] : nullptr;
      if (a && b && a->phase == b->phase && a->attempt == b->attempt && a->stage == b->stage && a->count == b->count)
        continue;
      add((a ? a : b)->stage,
          fmt::format("the budget cut {}: {}, now {}", k, a ? text(*a) : "none", b ? text(*b) : "none"));
      return;
    }
  }

  void compare_standing() {
    const auto text = [](const Plan& p) { return p.standing ? fmt::format("answer {}", *p.standing) : "none"; };
    if (a_.standing != b_.standing) {
      add(Stage::Check, fmt::format("the watchdog's: {}, now {}", text(a_), text(b_)));
    }
  }

  void compare_work() {
    if (a_work_ == nullptr || b_work_ == nullptr) return;
    note_numbers(Stage::BroadPhase, "hulls made", a_work_->hulls, b_work_->hulls);
    note_numbers(Stage::Search, "nodes expanded", a_work_->expansions, b_work_->expansions);
    note_numbers(Stage::Optimization, "solver iterations", a_work_->solver_iterations, b_work_->solver_iterations);
  }

  void compare_trajectories() {
    const bool optimized = a_.outcome == PlanOutcome::Optimized && b_.outcome == PlanOutcome::Optimized;
    note_numbers(Stage::Search, "start, µs", a_.trajectory.start.us, b_.trajectory.start.us);
    note_numbers(Stage::Search, "interval, µs", a_.trajectory.interval.us, b_.trajectory.interval.us);
    const Points& p = a_.trajectory.control_points;
    const Points& q = b_.trajectory.control_points;
    const Stage stage = optimized ? Stage::Optimization : Stage::Search;
    note_numbers(stage, "control points", p.cols(), q.cols());
    for (Eigen::Index k = 0; k < std::min(p.cols(), q.cols()); ++k) {
      if (p.col(k) == q.col(k)) continue;
      add(stage, fmt::format("control point {}: {}, now {}, {:.3g} m apart", k, text(p.col(k)), text(q.col(k)),
                             (p.col(k) - q.col(k)).norm()));
      return;
    }
  }

  void compare_certificates() {
    note_numbers(Stage::Check, "planes", a_.certificate.size(), b_.certificate.size());
    for (std::size_t k = 0; k < std::min(a_.certificate.size(), b_.certificate.size()); ++k) {
      const CertificatePlane& p = a_.certificate[k];
      const CertificatePlane& q = b_.certificate[k];
      const bool same_pair = p.track == q.track && p.interval == q.interval && p.part == q.part && p.parts == q.parts;
      if (same_pair && p.plane.n == q.plane.n && p.plane.d == q.plane.d) continue;
      add(Stage::Check, same_pair
                            ? fmt::format("plane {}: of track {} in interval {}: n {}, d {:.9g}; now n {}, d {:.9g}", k,
                                          p.track, p.interval, text(p.plane.n), p.plane.d, text(q.plane.n), q.plane.d)
                            : fmt::format("plane {}: of track {} in interval {}, now of track {} in interval {}", k,
                                          p.track, p.interval, q.track, q.interval));
      return;
    }
  }

  void compare_costs() {
    note_numbers(Stage::Check, "cost: distance to goal, m", a_.cost.distance_to_goal, b_.cost.distance_to_goal);
    note_numbers(Stage::Check, "cost: jerk", a_.cost.jerk, b_.cost.jerk);
    note_numbers(Stage::Check, "cost: attraction", a_.cost.attraction, b_.cost.attraction);
    note_numbers(Stage::Check, "cost: repulsion", a_.cost.repulsion, b_.cost.repulsion);
    note_numbers(Stage::Check, "cost: total", a_.cost.total, b_.cost.total);
  }

  void compare_outcomes() {
    if (a_.outcome == b_.outcome && a_.reason == b_.reason) return;
    add(Stage::Check, fmt::format("outcome: {} (reason: {}), now {} ({})", to_string(a_.outcome), to_string(a_.reason),
                                  to_string(b_.outcome), to_string(b_.reason)));
  }

  const Plan& a_;
  const Plan& b_;
  const PlanTiming* a_work_;
  const PlanStatistics* b_work_;
  std::vector<PartDifference> parts_;
};

}  // namespace

PlanDifference difference_of(const Plan& recorded, const Plan& again, const PlanTiming* recorded_work,
                             const PlanStatistics* work) {
  PlanDifference difference;
  Plan same_header = again;
  same_header.header = recorded.header;
  if (encode(recorded) == encode(same_header)) return difference;
  difference.parts = Comparison(recorded, again, recorded_work, work).run();
  if (recorded.outcome != PlanOutcome::NoPlan || again.outcome != PlanOutcome::NoPlan) {
    difference.position_m = distance_between(recorded.trajectory, again.trajectory);
  }
  const bool equivalent = recorded.outcome == again.outcome && difference.position_m <= kReplayTolerance;
  difference.agreement = equivalent ? Agreement::Equivalent : Agreement::Different;
  return difference;
}

void add_heading(const PlanHeading& recorded, const std::optional<PlanHeading>& again, PlanDifference& difference) {
  if (again && encode(recorded) == encode(*again)) return;
  if (!again || again->control_points.size() != recorded.control_points.size()) {
    difference.agreement = Agreement::Different;
    difference.parts.push_back(
        {Stage::Check, fmt::format("heading: {} control points, now {}", recorded.control_points.size(),
                                   again ? again->control_points.size() : 0)});
    return;
  }
  double apart = 0.0;
  for (std::size_t k = 0; k < recorded.control_points.size(); ++k) {
    apart = std::max(apart, std::abs(recorded.control_points[k] - again->control_points[k]));
  }
  difference.agreement =
      std::max(difference.agreement, apart <= kReplayTolerance ? Agreement::Equivalent : Agreement::Different);
  difference.parts.push_back({Stage::Check, fmt::format("heading: its yaws are up to {:.3g} rad apart", apart)});
}

}  // namespace tern
