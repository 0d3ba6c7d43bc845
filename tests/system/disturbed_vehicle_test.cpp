// A vehicle that is not where it was told to be, among obstacles and in walls.
#include <gtest/gtest.h>

#include "campaign/virtual_system.h"
#include "executor/app/executor_node.h"
#include "messages/channels.h"
#include "simulator/app/simulator_node.h"
#include "tests/support/watched_flight.h"

namespace tern::testing {
namespace {

class DisturbedFlight {
 public:
  DisturbedFlight(const std::string& scenario, const std::vector<std::string>& overrides)
      : system_(scenario_file(scenario), overrides) {
    Bus& bus = system_.runner().observer();
    bus.subscribe(channels::kHorizonRequest, [this](const HorizonRequest& request) {
      widest = widest.cwiseMax(request.tube);
      slowest = std::min(slowest, request.limits.v_max.x());
    });
    system_.runner().run(system_.runner().now() + Duration::from_seconds(200.0),
                         [this] { return system_.simulator().result().has_value(); });
  }
  [[nodiscard]] const FlightResult& result() const { return *system_.simulator().result(); }
  [[nodiscard]] std::int64_t exits() const { return system_.executor().exits(); }

  Vec3 widest = Vec3::Zero();  ///< tube
  double slowest = INFINITY;   ///< v_max that was asked for

 private:
  VirtualSystem system_;
};

TEST(DisturbedVehicle, InTheWindItIsBuiltForNeverLeavesItsTube) {
  const DisturbedFlight flight("quadrotor_corridor", {"seed=3"});
  expect_reached(flight.result());
  EXPECT_EQ(flight.exits(), 0);
}

TEST(DisturbedVehicle, PushedOutByAGustAmongObstaclesRejoinsWithoutAContact) {
  for (const int seed : {1, 2}) {
    SCOPED_TRACE(seed);
    const DisturbedFlight flight(
        "quadrotor_corridor", {"seed=" + std::to_string(seed), "simulator.wind.burst=15", "simulator.wind.burst_at_s=6",
                               "simulator.wind.burst_lasts_s=0.5"});
    EXPECT_EQ(flight.result().outcome, FlightOutcome::Reached) << flight.result().detail;
    EXPECT_GT(flight.exits(), 0);
  }
}

TEST(DisturbedVehicle, WithAControllerThreeTimesTooSoftFliesWithoutAContact) {
  const DisturbedFlight flight("quadrotor_corridor", {"seed=1", "simulator.quadrotor.controller.position_p=0.83",
                                                      "simulator.quadrotor.controller.velocity_p=1.7",
                                                      "simulator.quadrotor.controller.velocity_i=0.67"});
  EXPECT_EQ(flight.result().outcome, FlightOutcome::Reached) << flight.result().detail;
  EXPECT_GT(flight.exits(), 0);
}

TEST(DisturbedVehicle, WhoseEstimateJumpsRejoinsWhereItBelievesToBe) {
  const DisturbedFlight flight("quadrotor_corridor", {"seed=1", "world.count=10", "simulator.estimator.jump_m=0.6",
                                                      "simulator.estimator.jump_at_s=6"});
  EXPECT_EQ(flight.exits(), 1);
  EXPECT_EQ(flight.result().outcome, FlightOutcome::Timeout) << "in truth it hovers 0.6 m beside the goal";
}

TEST(DisturbedVehicle, PassesAWindowThatItsTubeDoesNotFitSlowly) {
  const DisturbedFlight flight("window", {"simulator.vehicle=quadrotor", "simulator.quadrotor.class=racer",
                                          "simulator.wind.speed=4", "uav.dynamics.tilt_max=60"});
  EXPECT_EQ(flight.result().outcome, FlightOutcome::Reached) << flight.result().detail;
  EXPECT_GE(flight.widest.minCoeff(), 0.25);
  EXPECT_LE(flight.slowest, 3.0);
}

}  // namespace
}  // namespace tern::testing
