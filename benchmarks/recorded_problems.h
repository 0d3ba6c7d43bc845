// Problems of Eq. 4 as flights pose them.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "planner/refinement.h"

namespace tern {

struct RecordedProblem {
  TrajectoryProblem trajectory;
  std::vector<SeparatedPair> pairs;
  Points initial;  ///< the search's control points

  [[nodiscard]] ConvexProblem convex() const;
};

/// Flies paper_corridor with 300, mader_corridor with 250 and sando_forest with 200 obstacles, each with this seed. Of
/// every request that a search answered the problem is handed over, until `take` says false.
void record_problems(std::uint64_t seed, const std::function<bool(const RecordedProblem&)>& take);

}  // namespace tern
