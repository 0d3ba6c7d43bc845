// How long a plan must at least take: per-axis time-optimal motion to rest.
#pragma once

#include "core/world/vehicle.h"

namespace tern {

/// The least time in which a double integrator gets from velocity v0 at 0 to rest at d, under |v| ≤ v_max and |a| ≤
/// a_max, s. With s = sign(d − v0|v0|/(2a)) it accelerates by s·a to a peak of √(a|d| + v0²/2) or v_max, cruises, and
/// brakes.
/// @pre v_max, a_max > 0. |v0| > v_max is taken as it is: braking to v_max counts.
double least_time_to_rest(double d, double v0, double v_max, double a_max);

/// The largest of the three axes, plus what a jerk limit adds at least to braking from the start's speed (a_max/j_max,
/// or less where the acceleration does not build up that far), s.
double least_duration(const MotionSample& start, const Vec3& to, const Limits& limits);

/// The limits by which progress is measured over flights of so many metres. Where jerk is so gentle that nowhere near
/// a_max is reached on the way (less than a tenth), a_max is what is reached from rest to rest, j T/4 with T = (32
/// d/j)^⅓: else braking would seem to take no time, and plans that overshoot would seem the best.
Limits paced(const Limits& limits, double metres);

/// What a plan's duration is counted from: least_duration() by the paced limits, but on no axis with a jerk limit more
/// than it takes to stop and then to fly from rest to rest time-optimally. least_duration() overestimates gentle jerk
/// by far, and is the better measure of progress, because it falls as soon as the vehicle moves, s.
double planned_duration(const MotionSample& start, const Vec3& to, const Limits& limits);

}  // namespace tern
