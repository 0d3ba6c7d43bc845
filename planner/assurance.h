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
/// needs to step aside will be predicted anew before it must be acted on. So α stops growing first (kGrowthTimes), then
/// the level falls (kReducedLevels). Of what follows no confidence is known: parts of that α (kAlphaScales). They grow
/// for the same time: α that did not would leave plans that speed up past what is near.
/// @param side_step_s  what the vehicle needs to step aside (HoldDemand), s
std::vector<Assurance> reduced_assurances(double side_step_s);

/// For as long as it is sure; 0 where none is known: below scale 1, or sure for no time.
/// @param set_confidence  the prediction set's (TrackSet::confidence)
double confidence_of(const Assurance& assurance, double set_confidence);

/// Counts α of the estimated obstacles so, whatever was counted before, and those of others in full.
void apply_assurance(const Assurance& assurance, UTime t_s, std::vector<PlanningObstacle>& obstacles);

}  // namespace tern
