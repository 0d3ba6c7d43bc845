// Local goals nearer than r: short plans, for a vehicle that must be able to rest soon.
#pragma once

#include <functional>

#include "planner/course.h"
#include "planner/incumbent.h"
#include "planner/schedule.h"

namespace tern {

/// Offers passively safe plans to the incumbent if its best candidate is not passively safe (passive_safety.h). Without
/// `planner.unseen: passive` it does nothing.
///
/// Every plan ends at rest, so a plan to a nearer local goal rests sooner. The radii fall by kNearerStep. Radii are
/// left out while a smooth way to the local goal, a cubic in time, is not clear of unseen movers. The first
/// kNearerTries of the others are searched and optimized, until one is passively safe and covers kMinSettledProgress of
/// its way. Thus the vehicle slows where it sees little. The progress of such a candidate is that to its own local
/// goal; its arrival is that of the course.
/// @param near    at the assurance of the trial
/// @param course  along the path
/// @param along   returns the course along the path with at most this radius, m
void try_nearer_goals(const Surroundings& near, const Course& course, const std::function<Course(double)>& along,
                      const Trial& trial, Incumbent& incumbent, PlanTools& tools);

}  // namespace tern
