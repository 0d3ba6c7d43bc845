// The figures of the paper's section 6.2: maps of flights, exposure against path length.
#pragma once

#include <string>
#include <vector>

#include "campaign/experiments/exposure_summary.h"
#include "campaign/experiments/flight_track.h"
#include "campaign/experiments/semantic_flights.h"

namespace tern {

/// Seen from above and from the side: regions, obstacles (movers where they are as the flight with semantics passes
/// them; from above alone), the path
/// without semantics in grey and the path with them, coloured by speed. SVG.
std::string draw_corridor(const FlightTrack& without, const FlightTrack& with, const std::string& title);

/// A dot per flight: metres inside against the path's length, with the means' 95 % intervals. SVG.
std::string draw_exposure(const std::vector<SemanticFlight>& flights, const std::vector<ExposureSummary>& summaries);

/// A line per method through its λ: exposure bought against path length spent, both against the same seeds without
/// semantics. SVG.
std::string draw_sweep(const std::vector<ExposureSummary>& summaries);

}  // namespace tern
