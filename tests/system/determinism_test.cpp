// The same flight twice gives the same bytes.
#include <gtest/gtest.h>

#include "campaign/virtual_system.h"
#include "messages/codec.h"
#include "tests/support/watched_flight.h"

namespace tern::testing {
namespace {

/// Returns every PLAN of the first seconds of a flight with moving and static obstacles and two regions.
std::vector<Bytes> plans_of(const std::string& cost) {
  VirtualSystem system(scenario_file("corridor_demo"), {"seed=3", "semantics.cost=" + cost});
  std::vector<Bytes> plans;
  system.runner().observer().subscribe(channels::kPlan, [&](const Plan& plan) { plans.push_back(encode(plan)); });
  system.runner().run(system.runner().now() + Duration::from_seconds(7.0));
  return plans;
}

TEST(VirtualFlight, TheSameFlightTwiceGivesTheSameBytesOfEveryPlan) {
  for (const char* cost : {"exposure", "mean_distance"}) {
    const std::vector<Bytes> first = plans_of(cost);
    EXPECT_GT(first.size(), 60U);
    EXPECT_EQ(first, plans_of(cost)) << cost;
  }
}

}  // namespace
}  // namespace tern::testing
