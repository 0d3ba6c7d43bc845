// Passive safety: a plan comes to rest before a mover that no sensor has seen can touch the vehicle.
#pragma once

#include "planner/surroundings.h"

namespace tern {

/// Returns when an unseen mover may touch the vehicle first while it moves on this trajectory, s after t_s
/// (first_contact). It is kNoContact if none can before the vehicle rests, and with `planner.unseen: ignore`.
///
/// A vehicle at rest is passively safe. A vehicle that has rested for longer than UnseenMovers::wait_s is not, so that
/// it departs with the longest time to contact where no passively safe plan exists.
/// @param trajectory  the committed one, or one that starts at t_s
double contact_time(const Surroundings& near, const TimedSpline& trajectory);

}  // namespace tern
