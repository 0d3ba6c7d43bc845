// Problems of Eq. 4 as flights pose them: recorded while flying seeded worlds with the tests' closed loop.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "planner/refinement.h"

namespace tern::benchmarks {

struct RecordedProblem {
  TrajectoryProblem trajectory;
  std::vector<SeparatedPair> pairs;
  Points initial;  ///< the search's control points

  [[nodiscard]] ConvexProblem convex() const;
};

/// The worlds that are flown: paper_corridor with 300, mader_corridor with 250, sando_forest with 200 obstacles.
inline constexpr const char* kRecordedWorlds[] = {"paper_corridor", "mader_corridor", "sando_forest"};

/// Flies the world at 20 Hz with its motions known, for 30 s at most. Hands over the problem of every request that a
/// search answered, until `take` says false. @return how many
int record_problems(const std::string& world, std::uint64_t seed,
                    const std::function<bool(const RecordedProblem&)>& take);

}  // namespace tern::benchmarks
