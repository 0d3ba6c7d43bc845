// Which plans the executor adopts, and why it refuses the others.
#pragma once

#include <cstdint>
#include <string>

#include "core/world/flyable.h"
#include "core/world/horizon.h"

namespace tern {

/// The executor's decision on one PLAN.
enum class Verdict : std::uint8_t {
  Adopted = 0,         ///< the vehicle flies it from t_s on
  Kept = 1,            ///< KeepCommitted: the request is answered by the committed trajectory
  NoPlan = 2,          ///< NoPlan: the request is answered, without a trajectory
  UnknownRequest = 3,  ///< refused: the request was never made, or is older than the memory of closed requests
  AnsweredTwice = 4,   ///< refused: the request already has its answer
  Late = 5,            ///< refused: received after the deadline and before t_s; the request was closed
  TooLate = 6,         ///< refused: received at or after t_s
  Stopped = 7,         ///< refused: GoalMode::Stop, no goal, or the vehicle does not follow
  Unflyable = 8,       ///< refused: the trajectory breaks a rule of breach_of()
};
inline constexpr int kVerdicts = 9;

/// Returns "adopted", "late", "unflyable" …
const char* to_string(Verdict verdict);
/// True for every verdict except Adopted, Kept and NoPlan.
constexpr bool is_refusal(Verdict verdict) { return verdict > Verdict::NoPlan; }

/// A verdict with its details.
struct Adoption {
  Verdict verdict = Verdict::NoPlan;
  std::string detail;            ///< of a refusal: axis, value and limit, or the request
  Breach breach = Breach::None;  ///< of Verdict::Unflyable: the broken rule
};
/// Returns the name of the breach if there is one, else that of the verdict: "flight box", "late" …
const char* to_string(const Adoption& adoption);

/// Checks `trajectory` against the start, limits, body, tube and flight box of `request` (core/world/flyable.h).
/// @return Verdict::Adopted or Verdict::Unflyable. O(J) for J intervals.
Adoption check_trajectory(const TimedSpline& trajectory, const HorizonRequest& request);

}  // namespace tern
