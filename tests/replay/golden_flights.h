// The flights of the golden logs.
#pragma once

#include <string>
#include <vector>

#include "tests/support/eventful_flight.h"

namespace tern::testing {

struct GoldenFlight {
  std::string name;
  EventfulFlight flight;
  double from_s = 0.0;  ///< answers are kept from this time of the log on
  int every = 1;        ///< every n-th of them is kept
};

/// corridor: movers and pillars; crowd: people whose motion is estimated; semantic: a region that draws and one that
/// repels. In evade an intruder comes at a vehicle that rests. In stale_world the predictor dies and comes back, and so
/// does the planner.
std::vector<GoldenFlight> golden_flights();

}  // namespace tern::testing
