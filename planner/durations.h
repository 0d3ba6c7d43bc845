// The loop over a few durations. A short one may leave the local goal out of reach; a long one is slow.
#pragma once

#include "planner/course.h"
#include "planner/incumbent.h"
#include "planner/schedule.h"

namespace tern {

/// Tries config.duration_scales of the planned duration, in order. Each search result is optimized and offered to the
/// incumbent.
///
/// The loop ends when is_long_enough() (stop_rule.h). It also ends with the budget, or when the obstacles are not known
/// for as long as the next duration and its hold.
/// @param trial  its phase and effort. The search's lengths are scaled() to local goals nearer than kFullStep.
/// @return the reason if there is no new plan
PlanReason try_durations(const Surroundings& near, const Course& course, const Trial& trial, Incumbent& incumbent,
                         PlanTools& tools);

}  // namespace tern
