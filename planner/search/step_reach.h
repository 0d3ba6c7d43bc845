// The velocity control points that may follow, such that limits hold and rest remains reachable. See
// docs/planner/search.md.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "planner/problem/horizon_problem.h"
#include "planner/safety/thrust_set.h"
#include "planner/search/axis_reach.h"

namespace tern {

/// Three AxisReach within plan_limits, and a multirotor's thrust if they have dynamics.
///
/// Dynamics couple the axes. per_axis_limits() imply them, so an end at rest that these limits reach can be flown. One
/// step may use any acceleration in the ThrustSet, at any allowed body rate, if later steps can end at rest within
/// per_axis_limits(). Each state after a flyable() step therefore has such a step again. More states are
/// reachable than within per_axis_limits() alone.
class StepReach {
 public:
  /// Keeps its memory from call to call.
  void assign(const HorizonProblem& problem);

  /// Returns bounds of q_{n−2} − q_l on this axis (AxisReach::displacement), m.
  [[nodiscard]] AxisReach::Interval displacement(int axis, int l, double v_previous) const {
    return steps_[shared_[idx(axis)]].displacement(l, v_previous);
  }

  /// The velocities that may follow v_l and a_{l−1}.
  struct Steps {
    Vec3 v, a;                                  ///< v_l, m/s, and a_{l−1}, m/s²
    std::array<AxisReach::Interval, 3> range;   ///< per axis, m/s
    std::array<AxisReach::Interval, 3> steady;  ///< with dynamics: the part within per_axis_limits(), m/s
  };
  [[nodiscard]] Steps from(int l, const Vec3& v, const Vec3& a_previous) const;

  /// Returns the wanted velocity if it can be flown, else the first of kReturnShares of the way to the steady range
  /// that can. @return nullopt if none can
  [[nodiscard]] std::optional<Vec3> flyable(const Steps& from, const Vec3& wanted) const {
    return thrust_ ? with_thrust(from, wanted) : wanted;
  }

 private:
  [[nodiscard]] std::optional<Vec3> with_thrust(const Steps& from, const Vec3& wanted) const;

  double dt_ = 0.0;
  std::array<std::size_t, 3> shared_{};      ///< per axis: the first axis with the same limits
  std::array<AxisReach, 3> steps_, steady_;  ///< one for each axis of shared_
  std::optional<ThrustSet> thrust_;
};

}  // namespace tern
