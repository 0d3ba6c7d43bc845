// Assurance: the share of estimated tracks' error bound α that a candidate is tested against. See
// docs/planner/choice.md.
#pragma once

#include <vector>

#include "core/wire/message_limits.h"
#include "planner/safety/swept_obstacles.h"

namespace tern {

/// The share of α that is applied to estimated tracks. Declared and static tracks always keep their full α.
struct Assurance {
  int level = 0;                 ///< index into kConfidenceLevels
  double scale = 1.0;            ///< factor on α at that level, (0, 1]; below 1 the confidence is unknown
  Duration sure_for = kMaxSpan;  ///< α grows until t_s + sure_for and stays constant from then on
};

/// Returns whether all of α applies, as long as movers are predicted.
inline bool is_full(const Assurance& assurance) {
  return assurance.level == 0 && assurance.scale == 1.0 && assurance.sure_for == kMaxSpan;
}

/// The reduced assurances in the order in which the schedule tries them:
///  1. α at the full level stops growing after kGrowthTimes · side_step_s. Later motion is predicted again before
///     the vehicle must act on it.
///  2. α at the levels kReducedLevels, growing for one side step.
///  3. kAlphaScales of α at the lowest level, growing for one side step. If this α did not grow, a plan could speed
///     up past an obstacle that is near.
/// @param side_step_s  HoldDemand::side_step_s, s
std::vector<Assurance> reduced_assurances(double side_step_s);

/// Returns the confidence that a trajectory certified at this assurance has up to t_s + sure_for. Returns 0 if it is
/// unknown: for scale < 1 or sure_for = 0.
/// @param set_confidence  confidence of the prediction set (TrackSet::confidence)
double confidence_of(const Assurance& assurance, double set_confidence);

/// Sets the α of every estimated obstacle to this assurance, and that of the others to full. Earlier values are lost.
void apply_assurance(const Assurance& assurance, UTime t_s, std::vector<PlanningObstacle>& obstacles);

}  // namespace tern
