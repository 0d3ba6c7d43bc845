// How long a plan must at least take: per-axis time-optimal motion to rest.
#pragma once

#include "core/world/vehicle.h"

namespace tern {

/// The least time in which a double integrator gets from velocity v0 at 0 to rest at d, under |v| ≤ v_max and |a| ≤
/// a_max, s. With s = sign(d − v0|v0|/(2a)) it accelerates by s·a to a peak of √(a|d| + v0²/2) or v_max, cruises, and
/// brakes.
/// @pre v_max, a_max > 0. |v0| > v_max is taken as it is: braking to v_max counts.
double min_time_to_rest(double d, double v0, double v_max, double a_max);

/// The largest of the three axes, plus what a jerk limit adds at least to braking from the start's speed, s. That is
/// a_max/j_max, or less where the acceleration does not build up that far.
double min_duration(const MotionSample& start, const Vec3& to, const Limits& limits);

/// The limits by which progress is measured over flights of so many metres. Jerk may be so gentle that less than a
/// tenth of a_max is reached on the way. Then a_max is what is reached from rest to rest: j T/4 with T = (32 d/j)^⅓.
/// Else braking would seem to take no time, and plans that overshoot would seem the best.
Limits paced(const Limits& limits, double metres);

/// What a plan's duration is counted from, s: min_duration() by the paced limits. On an axis with a jerk limit it is
/// at most the time to stop and then to fly on from rest time-optimally. For gentle jerk min_duration() is far too
/// long. Yet it is the better measure of progress, because it falls as soon as the vehicle moves.
double planned_duration(const MotionSample& start, const Vec3& to, const Limits& limits);

}  // namespace tern
