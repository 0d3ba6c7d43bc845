// How sure a plan is: how much of estimated tracks' α it counts.
#pragma once

#include <vector>

#include "core/world/message_limits.h"
#include "planner/safety/swept_obstacles.h"

namespace tern {

/// What counts of the α of what is estimated. What is declared or static counts in full, always.
struct Assurance {
  int level = 0;                 ///< of kConfidenceLevels
  double scale = 1.0;            ///< of α at that level, (0, 1]; below 1 no confidence is known
  Duration sure_for = kMaxSpan;  ///< so long after t_s α grows; what is later counts with the α of then
};

/// What is tried, in this order, where nothing is had at the promised level to the end. What is later than the vehicle
/// needs to step aside will be predicted anew before it must be acted on. So α stops growing first (kSureTimes), then
/// the level falls (kLowerLevels). What follows is less than the vehicle needs: α for shorter times (kShortTimes), then
/// parts of the α at t_s itself (kAlphaScales).
/// @param aside_s  what the vehicle needs to step aside (HoldDemand), s
std::vector<Assurance> lower_assurances(double aside_s);

/// Whether that is less than a vehicle needs that steps aside in aside_s.
bool is_too_short(const Assurance& assurance, double aside_s);

/// Counts α of the estimated obstacles so, whatever was counted before, and those of others in full.
void count_alpha(const Assurance& assurance, UTime t_s, std::vector<PlanningObstacle>& obstacles);

}  // namespace tern
