// The adoption rule: which plans a vehicle flies, and in which words it refuses the others.
#pragma once

#include <cstdint>
#include <string>

#include "core/world/horizon.h"

namespace tern {

/// What became of a plan.
enum class Verdict : std::uint8_t {
  Adopted = 0,         ///< flown from t_s on
  Kept = 1,            ///< KeepCommitted: nothing to adopt, the request is answered
  NoPlan = 2,          ///< NoPlan: nothing to adopt, the request is answered
  UnknownRequest = 3,  ///< refused: answers a request that was never made, or one too old to be remembered
  AnsweredTwice = 4,   ///< refused: that request has its answer
  Late = 5,            ///< refused: after the deadline, before t_s: the request was closed
  TooLate = 6,         ///< refused: at or after t_s
  Stopped = 7,         ///< refused: the vehicle was told to stop (GoalMode::Stop) or has no mission
  Shape =
      8,  ///< refused: fewer than 4 intervals or too many, an interval not in (0, kLongestInterval], numbers not finite
  Start = 9,          ///< refused: does not start at t_s
  Join = 10,          ///< refused: position, velocity or acceleration leaves the committed trajectory at t_s
  End = 11,           ///< refused: does not end at rest
  Velocity = 12,      ///< refused: beyond v_max at its true extremum
  Acceleration = 13,  ///< refused: beyond a_max
  Jerk = 14,          ///< refused: beyond j_max
  FlightBox = 15,     ///< refused: the body leaves the flight box
};
inline constexpr int kVerdicts = 16;

/// "adopted", "late", "flight box" …
const char* to_string(Verdict verdict);
/// Everything but Adopted, Kept and NoPlan.
constexpr bool is_refusal(Verdict verdict) { return verdict > Verdict::NoPlan; }

/// A verdict and, for a refusal, the axis, value and limit in words.
struct Adoption {
  Verdict verdict = Verdict::NoPlan;
  std::string detail;
};

/// Whether `trajectory` may be flown after `request`: form (J ≥ 4), start at t_s, joining request.start within
/// kJoinTolerance, ending at rest, |v|, |a|, |j| within limits·(1 + kLimitTolerance) at their true extrema, the body
/// and its tube within the flight box to kBoxTolerance (true extrema too). The first rule broken is named, in that
/// order. Verdict::Adopted when all hold. O(J).
Adoption check_trajectory(const TimedSpline& trajectory, const HorizonRequest& request);

}  // namespace tern
