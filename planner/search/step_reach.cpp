#include "planner/search/step_reach.h"

#include <algorithm>

#include "planner/problem/tuning.h"

namespace tern {
namespace {

/// Returns whether two axes have the same limits.
bool are_equal(const Limits& limits, int a, int b) {
  return limits.v_max[a] == limits.v_max[b] && limits.a_max[a] == limits.a_max[b] && limits.j_max[a] == limits.j_max[b];
}

}  // namespace

void StepReach::assign(const HorizonProblem& problem) {
  dt_ = problem.interval_s();
  const Limits& limits = problem.plan_limits;
  const Limits box = per_axis_limits(limits);
  thrust_.reset();
  if (limits.dynamics) thrust_.emplace(*limits.dynamics);
  for (int axis = 0; axis < 3; ++axis) {
    int first = 0;
    while (first < axis && !(are_equal(limits, first, axis) && are_equal(box, first, axis))) ++first;
    shared_[idx(axis)] = idx(first);
    if (first < axis) continue;
    AxisReach& steps = steps_[idx(axis)];
    AxisReach& steady = steady_[idx(axis)];
    const double v_max = limits.v_max[axis];
    if (!thrust_) {
      steps.assign(problem.intervals, dt_, v_max, limits.a_max[axis], limits.j_max[axis]);
    } else {
      steady.assign(problem.intervals, dt_, v_max, box.a_max[axis], box.j_max[axis]);
      steps.assign_before(steady, limits.a_max[axis], limits.j_max[axis]);
    }
  }
}

StepReach::Steps StepReach::from(int l, const Vec3& v, const Vec3& a_previous) const {
  Steps out{v, a_previous, {}, {}};
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = idx(axis);
    out.range[i] = steps_[shared_[i]].next_velocity(l, v[axis], a_previous[axis]);
    if (!thrust_) continue;
    const AxisReach::Interval steady = steady_[shared_[i]].next_velocity(l, v[axis], a_previous[axis]);
    out.steady[i] = {std::max(steady.low, out.range[i].low), std::min(steady.high, out.range[i].high)};
  }
  return out;
}

std::optional<Vec3> StepReach::with_thrust(const Steps& from, const Vec3& wanted) const {
  const auto may_follow = [&](const Vec3& v) { return thrust_->allows(from.a, (v - from.v) / dt_, dt_); };
  if (may_follow(wanted)) return wanted;
  Vec3 back = wanted;
  for (int axis = 0; axis < 3; ++axis) {
    const AxisReach::Interval& steady = from.steady[idx(axis)];
    if (!steady.empty()) back[axis] = std::clamp(wanted[axis], steady.low, steady.high);
  }
  for (const double share : kReturnShares) {
    const Vec3 v = wanted + share * (back - wanted);
    if (may_follow(v)) return v;
  }
  return std::nullopt;
}

}  // namespace tern
