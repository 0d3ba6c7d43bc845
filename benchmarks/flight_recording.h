// The requests of a whole virtual flight, each with the world that the planner answered it in.
#pragma once

#include <string>
#include <vector>

#include "core/world/flight_result.h"
#include "core/world/scenario.h"
#include "planner/planner.h"

namespace tern {

/// What plan() is given.
struct Moment {
  HorizonRequest request;
  PlanningWorld world;
};

struct FlightRecording {
  Scenario scenario;
  PlannerConfig config;
  FlightResult result;
  std::vector<Moment> moments;
};

/// Flies a scenario file (with `key=value` overrides) on virtual time and keeps what its planner was asked.
/// @throws ConfigError for what run_process would refuse.
FlightRecording record_flight(const std::string& scenario_file, const std::vector<std::string>& overrides);

}  // namespace tern
