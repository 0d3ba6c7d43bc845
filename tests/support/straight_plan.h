// A planner for empty worlds: straight to the goal, with minimal jerk for the shortest feasible duration.
#pragma once

#include "core/world/horizon.h"

namespace tern {

struct StraightPlanOptions {
  int intervals = 10;        ///< J ≥ 6
  double reach_m = 8.0;      ///< a plan ends at most this far from its start, m
  double limit_share = 0.9;  ///< of the limits that a plan may use, (0, 1]
};

/// Answers `request` and ignores obstacles.
///
/// The plan leads from the request's start to the goal, or reach_m towards it, and ends at rest. q_3 … q_{n-3}
/// minimize Σ‖jerk‖²; the interval is the first of a geometric scan that obeys the limits. The answer is
/// KeepCommitted, if
///
/// * the vehicle rests at the goal (AtGoal),
/// * the committed trajectory ends at the goal (WorsePlan), or
/// * no duration obeys the limits (Infeasible).
Plan straight_plan(const HorizonRequest& request, const Vec3& goal, const StraightPlanOptions& options = {});

/// Returns a plan of 8 m that starts in the origin at t_s, as a planner sends it.
Plan some_plan(UTime t_s);

}  // namespace tern
