// Data of the figures of the paper's section 6, as JSON; docs/results/figures.py draws them.
#pragma once

#include <string>
#include <vector>

#include "campaign/experiments/flight_track.h"
#include "campaign/experiments/search_experiment.h"

namespace tern {

/// Returns title, start, goal and regions per case of search_cases(). If a path was found, its segments follow. Each
/// has 25 points of the curve, both hulls, the plane with its gap, and the obstacle's box in the middle of the segment.
/// A plane is n, d of n·p = d; null if no plane separates the whole segment.
std::string search_data(const std::vector<SearchOutcome>& outcomes);

/// Returns regions, obstacles and both flights as rows of t, x, y, z, speed. A moving obstacle is drawn where it is
/// when the flight with semantics passes it.
std::string corridor_data(const FlightTrack& without, const FlightTrack& with);

}  // namespace tern
