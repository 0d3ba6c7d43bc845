// Evasion: the reachable stop that stays clear longest.
#pragma once

#include <optional>

#include "planner/attempt.h"

namespace tern {

/// Searches for stops in 14 directions around the vehicle (faces and corners of a cube) at two distances, each with as
/// long a hold as is looked for; the longest clear time wins, ties by order. Ends early when one holds to the cap or
/// the budget is spent. The outcome is Evade. Nothing: no certified stop was found.
std::optional<Candidate> find_evasion(const AttemptContext& context);

}  // namespace tern
