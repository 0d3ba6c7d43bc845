// The flights of the golden logs.
#pragma once

#include <string>
#include <vector>

#include "tests/support/eventful_flight.h"

namespace tern::testing {

struct GoldenFlight {
  std::string name;
  EventfulFlight flight;
  double from_s = 0.0;  ///< answers are stored from this time of the log on
  int every = 1;        ///< every n-th of them is stored
};

/// - corridor: moving and static obstacles
/// - crowd: people whose motion is estimated
/// - semantic: an attracting and a repelling region
/// - evade: an intruder flies at a stationary vehicle
/// - stale_world: predictor and planner end and restart
std::vector<GoldenFlight> golden_flights();

}  // namespace tern::testing
