// The requests of a whole virtual flight, each with the world that the planner answered it in.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/world/flight_result.h"
#include "core/world/scenario.h"
#include "planner/planner.h"

namespace CLI {
class App;
}

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

/// The flights that a program is asked to look at: --config, --set, --first and --last.
struct FlightSelection {
  std::string scenario;
  std::vector<std::string> overrides;  ///< key=value
  std::int64_t first = 1, last = 1;    ///< seeds

  void add_options(CLI::App& app);
  void each(const std::function<void(std::int64_t seed, const FlightRecording& flight)>& use) const;
};

/// CPU time that this thread spends on the work, ms.
double cpu_ms_of(const std::function<void()>& work);
/// … on the answer to one request, without a limit.
double plan_ms(const Moment& moment, const PlannerConfig& config, PlanWorkspace& workspace);

/// "p50 1.000  p90 2.000  p99 3.000  max 4.000". @pre not empty
std::string percentiles_text(std::vector<double> values);

}  // namespace tern
