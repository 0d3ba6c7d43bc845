#include "planner/search/step_reach.h"

#include <algorithm>

#include "planner/problem/tuning.h"

namespace tern {

void StepReach::assign(const HorizonProblem& problem) {
  dt_ = problem.interval_s();
  const Limits& limits = problem.plan_limits;
  const Limits box = boxed(limits);
  thrust_.reset();
  if (limits.dynamics) thrust_.emplace(*limits.dynamics);
  for (int axis = 0; axis < 3; ++axis) {
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
    out.range[i] = steps_[i].next_velocity(l, v[axis], a_previous[axis]);
    if (thrust_) out.steady[i] = steady_[i].next_velocity(l, v[axis], a_previous[axis]);
  }
  return out;
}

std::optional<Vec3> StepReach::flyable(const Steps& from, const Vec3& wanted) const {
  if (!thrust_) return wanted;
  Vec3 back = wanted;
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = idx(axis);
    const AxisReach::Interval steady{std::max(from.steady[i].low, from.range[i].low),
                                     std::min(from.steady[i].high, from.range[i].high)};
    if (!steady.empty()) back[axis] = std::clamp(wanted[axis], steady.low, steady.high);
  }
  for (const double share : kReturnShares) {
    const Vec3 v = wanted + share * (back - wanted);
    if (thrust_->allows(from.a, (v - from.v) / dt_, dt_)) return v;
  }
  return std::nullopt;
}

}  // namespace tern
