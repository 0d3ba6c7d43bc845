// Eq. 4 applied to a leaf of the search. See docs/planner/optimization.md.
#pragma once

#include <vector>

#include "planner/attempt.h"
#include "planner/optimization/joint_problem.h"

namespace tern {

/// Optimizes a leaf by the configured method, within the budget's stage Optimization.
///
/// The optimized trajectory is kept if the checker passes it and it replaces_leaf() (preference.h).
/// @return the optimized trajectory, or the leaf
Candidate refined(const Attempt& attempt, Candidate leaf, SeparationCache& swept, PlanTools& tools);

/// Returns Eq. 4 for a leaf. Its goal is the local goal. With semantics its goal is the leaf's own end, because the
/// search chose that end by the regions. If the leaf ends within one band of the goal, the local goal is used even
/// then.
TrajectoryProblem trajectory_problem(const Attempt& attempt, const Points& leaf);

/// Returns the plane of widest margin and the hull for every pair near the trajectory. Such planes leave the optimizer
/// the most room.
std::vector<SeparatedPair> gather_pairs(const Attempt& attempt, const TimedSpline& trajectory, SeparationCache& swept,
                                        PlanTools& tools);

}  // namespace tern
