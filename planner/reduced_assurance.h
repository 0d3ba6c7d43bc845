// Plans at a reduced assurance, where no plan holds at the full one. See docs/planner/choice.md.
#pragma once

#include "planner/course.h"
#include "planner/incumbent.h"
#include "planner/plan_log.h"
#include "planner/surroundings.h"

namespace tern {

/// Returns whether no lower assurance is needed: a candidate, new or committed, holds and makes kMinSettledProgress.
///
/// A candidate that waits or flies back does not settle it. Among growing boxes the surest plan would lead away from
/// the goal again and again.
bool is_settled(const Surroundings& near, const Course& course, const Incumbent& incumbent);

/// Tries reduced_assurances() in order until is_settled(). At each one it checks the committed trajectory, if that was
/// not clear before, and searches the durations.
///
/// Let c be the confidence of an assurance, 0 if it is unknown. The vehicle has waited once it has been at rest for
/// more than (1 − c)·kMaxWaitAtRest.
///  - An assurance at the full level whose α grows as long as movers are predicted is skipped: it equals the full
///    assurance.
///  - At a scale below 1 the loop ends if there is any candidate and the vehicle has not waited. A committed
///    trajectory that is clear at a larger α is surer.
///  - If the start stays relaxed at an assurance, that assurance is skipped. The last one is tried all the same.
///  - At a scale of 1 the loop ends if the vehicle is stationary, its stop holds, and it has not waited. An obstacle
///    that has just come into view is soon better known.
///
/// If there is no candidate in the end, the stop that stays clear longest is sought (find_evasion).
/// @param near  changed to the surroundings at the last assurance
/// @return the reason if there is no new plan
PlanReason plan_with_reduced_assurance(const Course& course, Surroundings& near, Incumbent& incumbent,
                                       PlanTools& tools);

}  // namespace tern
