// A whole flight in one process on virtual time, with the nodes of the real processes on one memq:// network.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "campaign/recorded_flight.h"
#include "core/world/flight_result.h"
#include "core/world/horizon.h"
#include "executor/executor.h"

namespace tern {

struct VirtualFlight {
  FlightResult result;
  ExecutorCounters executor;
  std::array<std::int64_t, kPlanOutcomes> outcomes = {};  ///< answers by PlanOutcome
  std::array<std::int64_t, kPlanReasons> reasons = {};    ///< answers by PlanReason
  std::vector<PlanTiming> timings;  ///< one per answer; wall and CPU times are those of this machine
  std::string end;                  ///< how the run ended if there is no result
};

/// Flies a scenario file, with `key=value` overrides, to its end.
/// @throws ConfigError if run_process would refuse the scenario
VirtualFlight fly_virtually(const std::string& scenario_file, const std::vector<std::string>& overrides,
                            FlightObserver* observer = nullptr);

}  // namespace tern
