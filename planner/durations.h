// A few durations to the local goal: too short a one leaves it out of reach, too long a one is slow.
#pragma once

#include "planner/heading.h"
#include "planner/plan_log.h"
#include "planner/standing_answer.h"
#include "planner/surroundings.h"

namespace tern {

/// Tries the scales of the least duration, in order; each leaf is optimized, and the best stands. Ends with the first
/// end that holds near the local goal (from rest: that gets on, too), or with the budget.
/// @param phase   whose attempts these are
/// @param search  its lengths are for local goals at kFullStep and beyond
/// @return why there is no plan
PlanReason try_durations(const Surroundings& near, const Heading& heading, Phase phase, const SearchConfig& search,
                         StandingAnswer& standing, PlanTools& tools);

}  // namespace tern
