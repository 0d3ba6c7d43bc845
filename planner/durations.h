// The loop over a few durations. A short one may leave the local goal out of reach; a long one is slow.
#pragma once

#include "planner/course.h"
#include "planner/incumbent.h"
#include "planner/plan_log.h"
#include "planner/surroundings.h"

namespace tern {

/// Tries config.duration_scales of the planned duration, in order. Each search result is optimized and offered to the
/// incumbent.
///
/// The loop ends with the first candidate that holds and ends within kAtLocalGoal of the local goal. At rest this
/// candidate must also make progress. The loop also ends with the budget, or when the obstacles are not known for as
/// long as the next duration and its hold.
/// @param phase   the phase that the attempts are counted in
/// @param search for local goals at kFullStep and beyond; it is scaled() for nearer ones
/// @return the reason if there is no new plan
PlanReason try_durations(const Surroundings& near, const Course& course, Phase phase, const SearchConfig& search,
                         Incumbent& incumbent, PlanTools& tools);

}  // namespace tern
