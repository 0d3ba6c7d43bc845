// A search result made better by Eq. 4.
#pragma once

#include <optional>
#include <vector>

#include "planner/attempt.h"
#include "planner/optimization/joint_problem.h"

namespace tern {

/// Optimizes a search result by the configured method, within the budget's stage Optimization. Nothing: the method is
/// SearchOnly, or no iterate is better that the checker passes and that holds as long as was required (or as `searched`
/// did).
std::optional<Candidate> refine(const AttemptContext& context, SweptObstacles& obstacles, const Candidate& searched);

/// Eq. 4 for a search result. Its goal is the local goal; with semantics the leaf's own end, which stands where it does
/// on purpose, unless that is in the last band.
TrajectoryProblem trajectory_problem(const AttemptContext& context, const TimedSpline& searched);

/// Planes of widest margin, and hulls, for every pair near the trajectory: they leave the optimizer the most room.
std::vector<SeparatedPair> gather_pairs(const AttemptContext& context, SweptObstacles& obstacles,
                                        const TimedSpline& trajectory);

}  // namespace tern
