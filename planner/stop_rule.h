// The stop rule: when the incumbent is good enough for a trial of the schedule. See docs/planner/choice.md.
#pragma once

#include "planner/incumbent.h"
#include "planner/schedule.h"

namespace tern {

/// Returns whether the incumbent is good enough, so that the trial is left out.
///
/// | trial                     | left out if                                                                         |
/// |---------------------------|-------------------------------------------------------------------------------------|
/// | Room                      | never                                                                               |
/// | Goal at full assurance    | room was found                                                                      |
/// | Goal at reduced assurance | the assurance is settled                                                            |
/// | Goal at a scaled α        | it is settled; or there is a candidate, and the vehicle has not waited              |
/// | Step                      | room was found, or the best makes progress                                          |
/// | Stop at full assurance    | the best holds; or the committed one holds, and nothing declared meets a vehicle    |
/// |                           | that is to stay                                                                     |
/// | Stop at reduced assurance | there is a candidate                                                                |
///
/// - *Settled*: a candidate, new or committed, holds and covers kMinSettledProgress of the way to the local goal. A
///   candidate that waits or flies back does not settle it. Among growing boxes the surest plan would lead away from
///   the goal again and again.
/// - The vehicle *has waited* once it has been at rest for more than Trial::wait_s. A committed trajectory that is
///   clear at a larger α is surer than any plan at a scaled one.
/// @param near  at full assurance
bool is_good_enough(const Incumbent& incumbent, const Trial& next, Task task, const Surroundings& near);

/// Returns whether the vehicle waits: it is stationary, its stop holds at an assurance of known confidence, and it has
/// not waited. An obstacle that has just come into view is soon better known. A vehicle that waits tries no more.
bool waits(const Incumbent& incumbent, const Trial& next, const Surroundings& near);

/// Returns whether no longer duration is tried in a trial: the best candidate holds and ends within kAtLocalGoal of the
/// local goal. At rest it must also make progress.
bool is_long_enough(const Incumbent& incumbent, const Course& course, const Surroundings& near);

}  // namespace tern
