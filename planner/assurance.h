// How sure a plan is: how much of estimated tracks' α it counts.
#pragma once

#include <vector>

#include "planner/safety/swept_obstacles.h"

namespace tern {

/// What counts of the α of what is estimated. What is declared or static counts in full, always.
struct Assurance {
  int level = 0;       ///< of kConfidenceLevels
  double scale = 1.0;  ///< of α at that level, (0, 1]; below 1 no confidence is known
};

/// What is tried, in this order, where nothing is had at the promised level: the other levels, then less and less of
/// the last one.
const std::vector<Assurance>& lower_assurances();

/// Counts α of the estimated obstacles so, whatever was counted before, and those of others in full.
void count_alpha(const Assurance& assurance, std::vector<PlanningObstacle>& obstacles);

}  // namespace tern
