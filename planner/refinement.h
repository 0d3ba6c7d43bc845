// A search result made better by Eq. 4.
#pragma once

#include <vector>

#include "planner/attempt.h"
#include "planner/optimization/joint_problem.h"

namespace tern {

/// Optimizes a leaf by the configured method, within the budget's stage Optimization. An optimized trajectory may give
/// up neither the leaf's hold nor much of its arrival. Where intervals are short (kShortInterval), arrivals say little,
/// and it keeps most of the leaf's progress.
/// @return the best such trajectory that the checker passes, else the leaf
Candidate refined(const Attempt& attempt, Candidate leaf, SweptObstacles& swept, PlanTools& tools);

/// Eq. 4 for a leaf. Its goal is the local goal. With semantics it is the leaf's own end, which stands there on
/// purpose, unless that is in the last band.
TrajectoryProblem trajectory_problem(const Attempt& attempt, const Points& leaf);

/// Planes of widest margin, and hulls, for every pair near the trajectory: they leave the optimizer the most room.
std::vector<SeparatedPair> gather_pairs(const Attempt& attempt, const TimedSpline& trajectory, SweptObstacles& swept,
                                        PlanTools& tools);

}  // namespace tern
