// The true motion in continuous time: the vehicle's and the obstacles' motion between recorded samples.
#pragma once

#include <vector>

#include "tools/audit/cubic.h"
#include "tools/audit/flight_record.h"

namespace tern::audit {

/// A motion over a time span, with bounds of its error.
struct MotionSpan {
  Curve curve;
  Vec3 error = Vec3::Zero();  ///< the true position is within curve ± error at each instant, m per axis
  double speed_error = 0.0;   ///< the true speed is within this of the curve's speed, m/s
  double wander_m = 0.0;      ///< the true path is at most this much longer than the curve's, m
  bool proven = true;         ///< false: nothing bounds the error; the curve interpolates between its ends
  bool hole = false;          ///< of the vehicle: no state for longer than kStateHole, so the flown motion is unknown
};

/// A longer time without a vehicle state is a hole.
inline constexpr Duration kStateHole{50'000};
/// A longer time between samples of a moving, undeclared obstacle is a hole: it may have vanished.
inline constexpr Duration kTruthHole{200'000};

/// A declared motion bridges at most this much time without a sample.
inline constexpr Duration kDeclaredHole{5'000'000};

/// A motion as consecutive spans.
struct SampledMotion {
  std::vector<MotionSpan> spans;  ///< ascending; an obstacle's holes are left out
  Duration holes;                 ///< total length of all holes
  std::int64_t hole_count = 0;    ///< number of holes
};

/// Reconstructs the vehicle's motion from its first to its last state, without a gap.
///
/// If both neighbouring states lie on the committed trajectory, that trajectory was flown exactly, however long no
/// state was recorded. "On" means position, velocity and acceleration to kJoinTolerance.
///
/// Elsewhere the curve is the Hermite cubic H through both states. Its error e = p − H is bounded by the greatest
/// acceleration A: the vehicle's limits, or the greatest recorded acceleration if that is larger. e and e′ vanish at
/// both ends, and |e″| ≤ M = A + max |H″|. Over a span of length h, per axis,
///
///     |e| ≤ M h²/16,   |e′| ≤ M h/4,   ∫|e′| ≤ M h²/8.
///
/// Each bound is attained by e″ = M, −M, M on the quarters [0, 1], [1, 3], [3, 4] of the span.
SampledMotion vehicle_motion(const FlightRecord& record);

/// Reconstructs an obstacle's motion between its samples.
///
/// - A declared motion holds within its α if the samples at both ends are within it.
/// - An undeclared motion is interpolated (proven = false).
/// - An obstacle that does not move is stationary.
SampledMotion obstacle_motion(const ObstacleHistory& history, const std::vector<DeclaredPiece>& declared);

/// The time that the referee judged, or all recorded time without a referee. The vehicle is judged until the verdict;
/// then it stops asking for plans.
struct Window {
  UTime from, to;   ///< contains the flight
  Duration unsure;  ///< the flight began at most this long after `from` and ended at most this long before `to`: one
                    ///< referee step
  [[nodiscard]] UTime sure_from() const { return from + unsure; }
  [[nodiscard]] UTime sure_to() const { return to - unsure; }
  [[nodiscard]] bool contains(UTime t) const { return t >= from && t <= to; }
};
/// Finds the judged time. The referee judges each state when it is published. So the verdict is later than the
/// second-last state before FLIGHT_RESULT. It is not later than FLIGHT_RESULT, nor than the first request plus
/// flight_time.
Window judged_window(const FlightRecord& record);

}  // namespace tern::audit
