// Where nothing is had at the promised confidence: the plan of the greatest one, new or committed.
#pragma once

#include "planner/heading.h"
#include "planner/plan_log.h"
#include "planner/standing_answer.h"
#include "planner/surroundings.h"

namespace tern {

/// Whether less need not be counted of α: something stands that holds, new or committed; of a vehicle that rests on its
/// way something new, which gets it on.
bool is_settled(const Surroundings& near, const Heading& heading, const StandingAnswer& standing);

/// Counts less and less of α (lower_assurances()) until that is settled. Below the known confidences it goes on only
/// while nothing stands at all: what is committed and clear of a larger α is surer than a new plan among parts of α.
/// Who finds nothing even so flies to the stop that stays clear longest.
/// @param near  afterwards the surroundings as they were counted last
/// @return why there is no plan
PlanReason plan_less_sure(const Heading& heading, Surroundings& near, StandingAnswer& standing, PlanTools& tools);

}  // namespace tern
