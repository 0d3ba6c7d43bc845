// Evasion: a trajectory to a stop that stays clear, sought without regard to the goal. See docs/planner/holds.md.
#pragma once

#include <optional>

#include "planner/attempt.h"
#include "planner/schedule.h"

namespace tern {

/// Searches for a stop around the vehicle; the outcome of the candidate is Evade.
///
/// | aim     | directions | distances                                                     | best stop                 |
/// |---------|------------|---------------------------------------------------------------|---------------------------|
/// | Stop    | 26         | kStopShares of r, kStopWidths of vehicle and mover            | stays clear longest       |
/// | Room    | 14         | kStopShares of r                                              | of the stops that hold,   |
/// |         |            |                                                               | farthest from every box   |
///
/// Each stop is tried at both kStopPaces; the quicker one only if nothing near is estimated. A forecast against the
/// obstacles' boxes sorts the stops: longest clear first, then the slower pace, then the soonest. The first kMaxStops
/// are searched; usually the first succeeds. The hold of each is tested as far as predictions reach.
///
/// For the aim Stop the first stop that stays clear as far as predictions reach ends the loop. The loop also ends
/// with the budget.
/// @param course  for the estimated arrivals
/// @param trial   its aim, phase and effort. @pre its aim is Room or Stop
/// @return the best stop, or nullopt if the checker passed none
std::optional<Candidate> find_evasion(const Surroundings& near, const Course& course, const Trial& trial,
                                      PlanTools& tools);

}  // namespace tern
