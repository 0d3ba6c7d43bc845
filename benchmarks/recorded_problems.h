// Optimization problems (Eq. 4) taken from flights.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "planner/refinement.h"

namespace tern {

/// One optimization problem of a flight.
struct RecordedProblem {
  TrajectoryProblem trajectory;
  std::vector<SeparatedPair> pairs;
  Points initial;  ///< the control points that the search found

  [[nodiscard]] ConvexProblem convex() const;
};

/// Flies paper_corridor with 300, mader_corridor with 250 and sando_forest with 200 obstacles, each with this seed.
/// Calls `take` with the problem of every request for which the search found a path, until `take` returns false.
void record_problems(std::uint64_t seed, const std::function<bool(const RecordedProblem&)>& take);

}  // namespace tern
