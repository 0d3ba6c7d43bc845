// Which velocity control points may follow, so that the limits hold and rest remains reachable.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "planner/problem/horizon_problem.h"
#include "planner/safety/thrust_set.h"
#include "planner/search/axis_reach.h"

namespace tern {

/// Three AxisReach by plan_limits, and a multirotor's thrust where they have dynamics.
///
/// Dynamics couple the axes. The limits per axis that per_axis_limits() finds imply them, so an end at rest that is
/// reachable by these can be flown. One step may use any acceleration in the ThrustSet, at any allowed body rate, if
/// later steps can end at rest by per_axis_limits limits. So every state that flyable() leads to has such a step again.
/// The set of states is larger than what per_axis_limits limits alone would reach.
class StepReach {
 public:
  /// Keeps its memory.
  void assign(const HorizonProblem& problem);

  /// How far q_{n-2} − q_l can lie on this axis (AxisReach).
  [[nodiscard]] AxisReach::Interval displacement(int axis, int l, double v_previous) const {
    return steps_[shared_[idx(axis)]].displacement(l, v_previous);
  }

  /// What may follow v_l and a_{l-1}: per axis, and the part of it that per_axis_limits limits reach.
  struct Steps {
    Vec3 v, a;
    std::array<AxisReach::Interval, 3> range;
    std::array<AxisReach::Interval, 3> steady;  ///< with dynamics only; empty where they reach none of it
  };
  [[nodiscard]] Steps from(int l, const Vec3& v, const Vec3& a_previous) const;

  /// The wanted velocity, or the first on the way from it to the steady range that may be flown.
  /// @return nullopt if none may
  [[nodiscard]] std::optional<Vec3> flyable(const Steps& from, const Vec3& wanted) const {
    return thrust_ ? with_thrust(from, wanted) : wanted;
  }

 private:
  [[nodiscard]] std::optional<Vec3> with_thrust(const Steps& from, const Vec3& wanted) const;

  double dt_ = 0.0;
  std::array<std::size_t, 3> shared_{};      ///< per axis: the first one with the same limits
  std::array<AxisReach, 3> steps_, steady_;  ///< of those
  std::optional<ThrustSet> thrust_;
};

}  // namespace tern
