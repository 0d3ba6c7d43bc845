// Where nothing is had at the promised confidence: the plan of the greatest one, new or committed.
#pragma once

#include "planner/course.h"
#include "planner/incumbent.h"
#include "planner/plan_log.h"
#include "planner/surroundings.h"

namespace tern {

/// Whether no less of α need be counted: something stands that holds and leads far enough (kMinSettledProgress), new or
/// committed. What waits or flies back does not settle it: among boxes that grow, the surest plan leads away from the
/// goal for ever.
bool is_settled(const Surroundings& near, const Course& course, const Incumbent& incumbent);

/// Counts less and less of α (reduced_assurances()) until that is settled. Where no confidence is known any more it
/// goes on only while nothing stands at all: a committed trajectory separated at a larger α is surer. Who stands still,
/// and at a confidence holds where it is, waits a moment (kMaxWaitAtRest), the longer the less sure it is. What has
/// come into view is soon known better. Who has rested for longer goes on all the same. Who finds nothing even so flies
/// to the stop that stays clear longest.
/// @param near  afterwards the surroundings as they were counted last
/// @return why there is no plan
PlanReason plan_with_reduced_assurance(const Course& course, Surroundings& near, Incumbent& incumbent,
                                       PlanTools& tools);

}  // namespace tern
