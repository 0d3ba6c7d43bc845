// A whole flight on virtual time that notes what its tests ask about: every request, every answer, when, and what
// became of it.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "tests/support/virtual_flight.h"

namespace tern::testing {

/// What went over the bus between executor and planner.
struct Exchange final : FlightObserver {
  std::map<std::int64_t, HorizonRequest> requests;  ///< by id
  std::vector<Plan> plans;                          ///< in order

  void on_request(const HorizonRequest& request) override { requests.emplace(request.id, request); }
  void on_plan(const Plan& plan) override { plans.push_back(plan); }
};

/// The path of a scenario of the project, "paper_corridor".
std::string scenario_file(const std::string& name);

/// Fails the running test unless the flight ended at its goal, unharmed and within every limit.
void expect_reached(const FlightResult& result);

/// Fails the running test unless each request was answered once, by its deadline and acceptably (the last may be open).
/// The executor's counts and what went over the bus must both say so.
void expect_answered_once_and_in_time(const ExecutorCounters& counters, const Exchange& exchange);

/// Flies, and expects both.
VirtualFlight fly_and_expect_all_well(const std::string& scenario, const std::vector<std::string>& overrides = {});

}  // namespace tern::testing
