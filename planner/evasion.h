// Evasion: the reachable stop that stays clear longest.
#pragma once

#include <optional>

#include "planner/attempt.h"

namespace tern {

/// Evasion's tries are numbered from here in the budget's counts, after the durations: a gate gives them time of their
/// own, because evasion is needed just when the search has spent its time in vain.
inline constexpr int kFirstEvasionAttempt = 100;

enum class EvasionAim {
  LongestClear,       ///< the stop that stays clear longest; the first that does to the hold's cap ends the search
  GreatestClearance,  ///< of the stops that hold, the one farthest from every obstacle's box: for a start inside a hull
};

/// Searches for stops in 14 directions around the vehicle (faces and corners of a cube) at two distances, each with as
/// long a hold as is looked for; those first that by the obstacles' boxes stay clear longest, so that the first try is
/// mostly the last. Ends early when the budget is spent. The outcome is Evade. Nothing: no certified stop was found.
std::optional<Candidate> find_evasion(const AttemptContext& context, EvasionAim aim);

}  // namespace tern
