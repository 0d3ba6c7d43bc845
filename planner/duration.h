// Lower bounds for the duration of a plan: per-axis time-optimal motion to rest.
#pragma once

#include "core/world/vehicle.h"

namespace tern {

/// Returns the least time in which a double integrator moves from velocity v0 at 0 to rest at d, s.
///
/// The limits are |v| ≤ v_max and |a| ≤ a_max. With s = sign(d − v0|v0|/(2 a_max)) it accelerates by s·a_max to a peak
/// of √(a_max |d| + v0²/2) or v_max, cruises, and brakes.
/// @pre v_max, a_max > 0. |v0| > v_max is allowed: braking to v_max takes its time.
double min_time_to_rest(double d, double v0, double v_max, double a_max);

/// Returns the largest min_time_to_rest() of the three axes, plus a lower bound of what the jerk limit adds to braking
/// from the start's speed, s. That is a_max/j_max, or less where the acceleration does not build up so far.
double min_duration(const MotionSample& start, const Vec3& to, const Limits& limits);

/// Returns the limits by which progress is measured over flights of this many metres.
///
/// Under a gentle jerk limit, less than kGentleShare of a_max is reached on the way. Then a_max is replaced by the
/// acceleration reached from rest to rest: j T/4 with T = (32 d/j)^⅓. Otherwise braking would seem to take no time, and
/// plans that overshoot would seem best.
Limits paced(const Limits& limits, double metres);

/// Returns the duration that plans are scaled from, s: min_duration() by the paced limits.
///
/// On an axis with a jerk limit it is at most the time to stop and then fly on time-optimally from rest. For gentle
/// jerk, min_duration() by itself is far too long. It is still the better measure of progress, because it decreases
/// as soon as the vehicle moves.
double planned_duration(const MotionSample& start, const Vec3& to, const Limits& limits);

}  // namespace tern
