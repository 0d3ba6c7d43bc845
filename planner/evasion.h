// Evasion: the reachable stop that stays clear longest.
#pragma once

#include <optional>

#include "planner/attempt.h"

namespace tern {

/// Tries up to 40 stops around the vehicle, in 26 directions, at leisure or in a hurry. They lie from a fraction of the
/// width of vehicle and largest mover to 0.8 r away. Room is sought in 14 directions, at 0.35 r and 0.8 r. A cheap
/// forecast by the obstacles' boxes sorts them: longest clear first, of equals the nearest. The first try usually
/// succeeds. Each stop's hold is followed as far as predictions reach. Ends early when the budget is spent. The outcome
/// is Evade.
/// @param phase    Evasion: the stop that stays clear longest; the first that does to the hold's cap ends the search.
///                 Room, for a start inside a hull: of the stops that hold, the one farthest from every obstacle's box
/// @param course  by which arrivals are estimated
/// @return the best stop, or nullopt if none passed the checker
std::optional<Candidate> find_evasion(const Surroundings& near, const Course& course, Phase phase, PlanTools& tools);

}  // namespace tern
