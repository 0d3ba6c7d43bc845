// Passive safety: a plan comes to rest before a mover that no sensor has seen can touch the vehicle.
#pragma once

#include "planner/surroundings.h"

namespace tern {

/// Returns the time to contact (first_contact) of a trajectory, s after t_s; kNoContact with `planner.unseen: ignore`.
///
/// A vehicle at rest is passively safe for UnseenMovers::wait_s. After that it departs with the longest time to contact
/// if no plan is passively safe.
/// @param trajectory  the committed one, or one that starts at t_s
double contact_time(const Surroundings& near, const TimedSpline& trajectory);

}  // namespace tern
