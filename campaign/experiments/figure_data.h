// What the figures of the paper's section 6 are drawn from, as JSON; docs/results/figures.py draws them.
#pragma once

#include <string>
#include <vector>

#include "campaign/experiments/flight_track.h"
#include "campaign/experiments/search_experiment.h"

namespace tern {

/// Per case of search_cases(): title, start, goal, regions. If something was found, per segment: 25 points of the
/// curve, both hulls, the plane and its gap, the obstacle's box in the segment's middle. The plane is n, d of n·p = d;
/// null: none separates the whole.
std::string search_data(const std::vector<SearchOutcome>& outcomes);

/// Regions, obstacles (movers where they are as the flight with semantics passes them) and both flights as rows of
/// t, x, y, z, speed.
std::string corridor_data(const FlightTrack& without, const FlightTrack& with);

}  // namespace tern
