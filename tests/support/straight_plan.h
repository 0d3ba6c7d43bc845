// A planner for empty worlds: straight to the goal, with the least jerk that the shortest feasible duration allows.
#pragma once

#include "core/world/horizon.h"

namespace tern {

struct StraightPlanOptions {
  int intervals = 10;        ///< J ≥ 6
  double reach_m = 8.0;      ///< a plan ends at most this far from its start, m
  double limit_share = 0.9;  ///< of the limits that a plan may use, (0, 1]
};

/// Answers `request` without looking at any obstacle. From the request's start to the goal, or as far towards it as
/// reach_m, at rest there. The q_3 … q_{n-3} minimize Σ‖jerk‖²; the interval is the first of a geometric scan that
/// keeps the limits. KeepCommitted (AtGoal) when it rests at the goal; KeepCommitted (WorsePlan) when the committed
/// trajectory ends there already; KeepCommitted (Infeasible) when no duration keeps the limits.
Plan straight_plan(const HorizonRequest& request, const Vec3& goal, const StraightPlanOptions& options = {});

}  // namespace tern
