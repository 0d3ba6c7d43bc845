// Records the planner's requests of a virtual flight, each with the world in which it was answered.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/scenario/scenario.h"
#include "core/world/flight_result.h"
#include "planner/planner.h"
#include "runtime/command_line.h"

namespace tern {

/// The arguments of one plan() call.
struct Moment {
  HorizonRequest request;
  PlanningWorld world;
};

/// A virtual flight and its plan() calls.
struct FlightRecording {
  Scenario scenario;
  PlannerConfig config;
  FlightResult result;
  std::vector<Moment> moments;
};

/// Flies a scenario file (with `key=value` overrides) on virtual time and records every plan() call.
/// @throws ConfigError for inputs that run_process() would refuse
FlightRecording record_flight(const std::string& scenario_file, const std::vector<std::string>& overrides);

/// The flights that the command line selects: --config, --set, --first and --last.
struct FlightSelection {
  std::string scenario;
  std::vector<std::string> overrides;  ///< key=value
  std::int64_t first = 1, last = 1;    ///< seeds, both included

  void add_options(CommandLine& app);
  void each(const std::function<void(std::int64_t seed, const FlightRecording& flight)>& use) const;
};

/// Returns the CPU time of this thread for `work`, ms.
double cpu_ms_of(const std::function<void()>& work);
/// Returns the CPU time of one plan() call without a time limit, ms.
double plan_ms(const Moment& moment, const PlannerConfig& config, PlanWorkspace& workspace);

/// Returns "p50 1.000  p90 2.000  p99 3.000  max 4.000". @pre values is not empty
std::string percentiles_text(std::vector<double> values);

}  // namespace tern
