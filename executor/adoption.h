// The adoption rule: which plans a vehicle flies, and in which words it refuses the others.
#pragma once

#include <cstdint>
#include <string>

#include "core/world/flyable.h"
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
  Unflyable = 8,       ///< refused: the trajectory may not be flown (breach_of)
};
inline constexpr int kVerdicts = 9;

/// "adopted", "late", "unflyable" …
const char* to_string(Verdict verdict);
/// Everything but Adopted, Kept and NoPlan.
constexpr bool is_refusal(Verdict verdict) { return verdict > Verdict::NoPlan; }

/// A verdict and, for a refusal, the axis, value and limit in words.
struct Adoption {
  Verdict verdict = Verdict::NoPlan;
  std::string detail;
  Breach breach = Breach::None;  ///< of Verdict::Unflyable: which rule is broken
};
/// The breach's words where there is one, else the verdict's: "flight box", "late" …
const char* to_string(const Adoption& adoption);

/// Whether `trajectory` may be flown after `request`: Verdict::Adopted or Verdict::Unflyable. O(J).
Adoption check_trajectory(const TimedSpline& trajectory, const HorizonRequest& request);

}  // namespace tern
