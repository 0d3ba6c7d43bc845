// Regions attract and repel whole flights, and never hold them up.
#include <gtest/gtest.h>

#include "tests/support/watched_flight.h"

namespace tern::testing {
namespace {

/// Exposure to one region, summed over seeds.
struct Sum {
  double inside_m = 0.0, near_m = 0.0;
};

/// Three seeds at half the usual rate of requests.
Sum exposure_of(const std::string& scenario, const std::vector<std::string>& overrides) {
  Sum sum;
  for (int seed = 1; seed <= 3; ++seed) {
    std::vector<std::string> all = overrides;
    all.insert(all.end(), {"executor.rate_hz=10", "seed=" + std::to_string(seed)});
    SCOPED_TRACE(scenario + ", seed " + std::to_string(seed));
    const VirtualFlight flight = fly_and_expect_all_well(scenario, all);
    sum.inside_m += flight.result.exposure.at(0).metres;
    sum.near_m += flight.result.exposure.at(0).near_metres;
  }
  return sum;
}

TEST(PaperAttract, MoreMetresLieInsideTheFacadeThanWithoutSemanticsWithBothCosts) {
  const Sum without = exposure_of("paper_attract", {"semantics.lambda_attractive=0"});
  for (const char* cost : {"exposure", "mean_distance"}) {
    const Sum with = exposure_of("paper_attract", {std::string("semantics.cost=") + cost});
    EXPECT_GT(with.inside_m, without.inside_m) << cost;
    RecordProperty(std::string(cost) + "_inside_m", std::to_string(with.inside_m));
  }
  RecordProperty("without_inside_m", std::to_string(without.inside_m));
}

TEST(PaperRepel, FewerMetresLieInAndNearThePoolThanWithoutSemanticsWithBothCosts) {
  const Sum without = exposure_of("paper_repel", {"semantics.lambda_repulsive=0"});
  for (const char* cost : {"exposure", "mean_distance"}) {
    const Sum with = exposure_of("paper_repel", {std::string("semantics.cost=") + cost});
    EXPECT_LE(with.inside_m, without.inside_m) << cost;
    EXPECT_LT(with.near_m, without.near_m) << cost;
    RecordProperty(std::string(cost) + "_near_m", std::to_string(with.near_m));
  }
  RecordProperty("without_near_m", std::to_string(without.near_m));
}

double metres_inside(const FlightResult& result, const std::string& region) {
  for (const Exposure& e : result.exposure) {
    if (e.region == region) return e.metres;
  }
  ADD_FAILURE() << "no region " << region;
  return 0.0;
}

TEST(Regions, SmokeAndPondAreAvoidedTheCanalIsCrossedTheShortWayAndTheGoalInTheReedsIsReached) {
  const FlightResult result = fly_and_expect_all_well("regions", {"executor.rate_hz=10"}).result;
  EXPECT_EQ(metres_inside(result, "smoke"), 0.0);
  EXPECT_LE(metres_inside(result, "pond"), 0.5);
  EXPECT_GE(metres_inside(result, "mural"), 6.0);
  EXPECT_LE(metres_inside(result, "canal"), 3.3) << "it is 3 m wide and blocks the whole way";
  EXPECT_LE(metres_inside(result, "reeds"), 1.8) << "1.5 m around the goal";
}

TEST(Regions, ADearerClassIsLeftForTheOneAroundIt) {
  // Without the passage beside the pond something must be crossed: the water, rather than the smoke in its middle.
  const FlightResult result =
      fly_and_expect_all_well("regions", {"executor.rate_hz=10", "uav.flight_box.max=[48, 3.4, 4]"}).result;
  EXPECT_LE(metres_inside(result, "smoke"), 0.2);
  EXPECT_GE(metres_inside(result, "pond"), 9.0);
}

TEST(PaperAttract, LambdaAttractiveEightStillArrives) {
  for (const char* cost : {"exposure", "mean_distance"}) {
    SCOPED_TRACE(cost);
    fly_and_expect_all_well("paper_attract", {"semantics.lambda_attractive=8", std::string("semantics.cost=") + cost,
                                              "executor.rate_hz=10"});
  }
}

}  // namespace
}  // namespace tern::testing
