// plan() again, as it was when a recorded answer was made.
#pragma once

#include <optional>

#include "planner/planner.h"
#include "tools/replay/world_rebuilder.h"

namespace tern {

struct Replanned {
  Plan plan;                                 ///< header and what a node adds to the inputs are the recorded answer's
  std::optional<PlanStatistics> statistics;  ///< nothing for an answer of the watchdog, which the worker outlived
};

/// Plans with the counts that `recorded` spent. Of a watchdog's answer: the improvement that it sent (the last one, if
/// there are fewer).
Replanned replan(const PlanProblem& problem, const Plan& recorded);

}  // namespace tern
