#include "tests/support/watched_flight.h"

#include <gtest/gtest.h>

#include "core/world/names.h"

namespace tern::testing {

std::string scenario_file(const std::string& name) { return std::string(TERN_SCENARIO_FOLDER) + "/" + name + ".yaml"; }

void expect_reached(const FlightResult& result) {
  EXPECT_EQ(result.outcome, FlightOutcome::Reached) << to_string(result.outcome) << ": " << result.detail;
  EXPECT_EQ(result.limit_violations, 0);
  EXPECT_FALSE(result.min_clearance_m < 0.0) << result.min_clearance_m;  // NaN where nothing ever came near
}

void expect_answered_once_and_in_time(const ExecutorCounters& counters, const Exchange& exchange) {
  EXPECT_GT(counters.requests, 0);
  EXPECT_GE(counters.answered_in_time, counters.requests - 1);
  EXPECT_EQ(counters.unanswered, 0);
  EXPECT_EQ(counters.late(), 0);
  EXPECT_EQ(counters.answered_twice(), 0);
  EXPECT_EQ(counters.refused(), 0);
  EXPECT_EQ(static_cast<std::int64_t>(exchange.requests.size()), counters.requests);
  std::map<std::int64_t, int> answers;
  for (const Plan& plan : exchange.plans) {
    ++answers[plan.request_id];
    const auto request = exchange.requests.find(plan.request_id);
    ASSERT_NE(request, exchange.requests.end()) << "an answer to request " << plan.request_id << ", which nobody made";
    EXPECT_LE(plan.header.utime, request->second.deadline) << "request " << plan.request_id;
  }
  for (const auto& [id, request] : exchange.requests) {
    if (id < counters.requests) {
      EXPECT_EQ(answers[id], 1) << "request " << id;
    }
  }
}

VirtualFlight fly_and_expect_all_well(const std::string& scenario, const std::vector<std::string>& overrides) {
  Exchange exchange;
  const VirtualFlight flight = fly_virtually(scenario_file(scenario), overrides, &exchange);
  EXPECT_EQ(flight.end, "");
  expect_reached(flight.result);
  expect_answered_once_and_in_time(flight.executor, exchange);
  return flight;
}

}  // namespace tern::testing
