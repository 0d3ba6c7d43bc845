// What really happened in continuous time: the vehicle's and the obstacles' motion between their recorded samples.
#pragma once

#include <vector>

#include "tools/audit/cubic.h"
#include "tools/audit/flight_record.h"

namespace tern::audit {

/// A motion over a stretch of time, and how far the truth may be from it.
struct MotionSpan {
  Curve curve;
  Vec3 error = Vec3::Zero();  ///< the truth is within curve ± error at each instant, m per axis
  double speed_error = 0.0;   ///< the true |v| is within |curve's v| ± this, m/s
  double wander_m = 0.0;      ///< the true path is longer than the curve's by at most this, m
  bool proven = true;         ///< false: nothing in the log bounds it; the curve is the interpolation of its ends
  bool hole = false;          ///< of the vehicle: no state for longer than kStateHole, nothing says what was flown
};

/// Without a state for longer than this the vehicle's motion is a hole, where the log does not tell what was flown.
inline constexpr Duration kStateHole{50'000};
/// Samples of a moving obstacle that nobody declared leave a hole if they are farther apart (it may have vanished).
inline constexpr Duration kTruthHole{200'000};

/// What was declared is not taken to bridge more than this without a sample.
inline constexpr Duration kDeclaredHole{5'000'000};

struct SampledMotion {
  std::vector<MotionSpan> spans;  ///< in order; an obstacle's holes are left out
  Duration holes;                 ///< how long they are together
  std::int64_t hole_count = 0;    ///< how many
};

/// The vehicle from its first to its last state, without a gap.
///
/// The log's requests may tell what was committed between two states. Where both lie on that trajectory (positions,
/// velocities, accelerations to kJoinTolerance), it is what was flown: exactly, however long no state was recorded.
/// Elsewhere the curve is the cubic H through both ends' positions and velocities. It rests on the vehicle's
/// acceleration limits A, or on the greatest acceleration recorded, if that is beyond them. e = p − H vanishes with its
/// derivative at both ends, and |e″| ≤ M = A + max |H″|. So over a span h, per axis,
///     |e| ≤ M h²/16,   |e′| ≤ M h/4,   ∫|e′| ≤ M h²/8,
/// each attained by e″ = M, −M, M on the span's quarters [0, 1], [1, 3], [3, 4].
SampledMotion vehicle_motion(const FlightRecord& record);

/// An obstacle between its samples. What its owner declared holds within its α, whatever the motion, where the samples
/// at both ends keep to it. What nobody declared is only interpolated (proven = false). What does not move, rests.
SampledMotion obstacle_motion(const ObstacleHistory& history, const std::vector<DeclaredPiece>& declared);

/// The time that the referee judged, or all that was recorded. After the verdict the vehicle asks for no more plans,
/// and answers for nothing.
struct Window {
  UTime from, to;   ///< the flight lies within
  Duration unsure;  ///< it began at most this after `from` and ended at most this before `to`: a step of the referee
  [[nodiscard]] UTime sure_from() const { return from + unsure; }
  [[nodiscard]] UTime sure_to() const { return to - unsure; }
  [[nodiscard]] bool contains(UTime t) const { return t >= from && t <= to; }
};
/// Each state is judged when it is published. So the verdict came after the last state but one before FLIGHT_RESULT. It
/// came no later than FLIGHT_RESULT, nor than flight_time after the first request.
Window judged_window(const FlightRecord& record);

}  // namespace tern::audit
