// A few durations to the local goal: too short a one leaves it out of reach, too long a one is slow.
#pragma once

#include "planner/course.h"
#include "planner/incumbent.h"
#include "planner/plan_log.h"
#include "planner/surroundings.h"

namespace tern {

/// Tries the scales of the least duration, in order; each leaf is optimized, and the best stands. Ends with the first
/// end that holds near the local goal (from rest: that gets on, too), or with the budget.
/// @param phase   whose attempts these are
/// @param search  its lengths are for local goals at kFullStep and beyond
/// @return why there is no plan
PlanReason try_durations(const Surroundings& near, const Course& course, Phase phase, const SearchConfig& search,
                         Incumbent& incumbent, PlanTools& tools);

}  // namespace tern
