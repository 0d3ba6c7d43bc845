// A whole flight on virtual time that records every request and answer, with their times, and the result.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "tests/support/virtual_flight.h"

namespace tern::testing {

/// The messages between executor and planner.
struct Exchange final : FlightObserver {
  std::map<std::int64_t, HorizonRequest> requests;  ///< by id
  std::vector<Plan> plans;                          ///< in order

  void on_request(const HorizonRequest& request) override { requests.emplace(request.id, request); }
  void on_plan(const Plan& plan) override { plans.push_back(plan); }
};

/// Returns the path of a scenario of the project, such as "paper_corridor".
std::string scenario_file(const std::string& name);

/// Fails the running test unless the flight reached its goal without contact and within all limits.
void expect_reached(const FlightResult& result);

/// Fails the running test unless each request got one acceptable answer by its deadline; the last one may be open. The
/// executor's counts and the messages must both show it.
void expect_answered_once_and_in_time(const ExecutorCounters& counters, const Exchange& exchange);

/// Flies, and expects both of the above.
VirtualFlight fly_and_expect_all_well(const std::string& scenario, const std::vector<std::string>& overrides = {});

}  // namespace tern::testing
