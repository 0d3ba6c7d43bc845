// A vehicle off its committed trajectory, among obstacles.
#include <gtest/gtest.h>

#include <array>

#include "campaign/virtual_system.h"
#include "executor/app/executor_node.h"
#include "simulator/app/simulator_node.h"
#include "tests/support/effort.h"
#include "tests/support/watched_flight.h"

namespace tern::testing {
namespace {

class DisturbedFlight {
 public:
  DisturbedFlight(const std::string& scenario, const std::vector<std::string>& overrides)
      : system_(scenario_file(scenario), overrides) {
    system_.runner().run(system_.runner().now() + Duration::from_seconds(200.0),
                         [this] { return system_.simulator().result().has_value(); });
  }
  [[nodiscard]] const FlightResult& result() const { return *system_.simulator().result(); }
  [[nodiscard]] std::int64_t exits() const { return system_.executor().tube_exits(); }

 private:
  VirtualSystem system_;
};

TEST(DisturbedVehicle, InTheWindItIsBuiltForNeverLeavesItsTube) {
  // Seeds 219, 307 and 343 left the tube when plans were received only 25 ms before they began; seed 699, when torque
  // lifted the vehicle.
  for (const int seed : support::first_at_effort<int>(1, {219, 3, 307, 343, 699})) {
    SCOPED_TRACE(seed);
    const DisturbedFlight flight("quadrotor_corridor", {"seed=" + std::to_string(seed)});
    expect_reached(flight.result());
    EXPECT_EQ(flight.exits(), 0);
  }
}

TEST(DisturbedVehicle, InAGustAmongObstaclesArrivesWithoutAContact) {
  for (const int seed : support::first_at_effort<int>(1, {1, 2})) {
    SCOPED_TRACE(seed);
    const DisturbedFlight flight(
        "quadrotor_corridor", {"seed=" + std::to_string(seed), "simulator.wind.burst=15", "simulator.wind.burst_at_s=6",
                               "simulator.wind.burst_lasts_s=0.5"});
    EXPECT_EQ(flight.result().outcome, FlightOutcome::Reached) << flight.result().detail;
  }
}

TEST(DisturbedVehicle, WhoseControllerIsThreeTimesTooSoftArrivesInStillAir) {
  for (const int seed : support::first_at_effort<int>(1, {1, 2})) {
    SCOPED_TRACE(seed);
    const std::string controller = "simulator.quadrotor.controller.";
    const DisturbedFlight flight(
        "quadrotor_corridor", {"seed=" + std::to_string(seed), "simulator.wind.speed=0", controller + "position_p=0.83",
                               controller + "velocity_p=1.67", controller + "velocity_i=0.67"});
    expect_reached(flight.result());
    EXPECT_EQ(flight.exits(), 0);
  }
}

/// A flight among `count` obstacles whose estimate jumps by 0.6 m, for good, after some seconds.
DisturbedFlight jumping(int seed, int count, int at_s) {
  return DisturbedFlight("quadrotor_corridor",
                         {"seed=" + std::to_string(seed), "world.count=" + std::to_string(count),
                          "simulator.estimator.jump_m=0.6", "simulator.estimator.jump_at_s=" + std::to_string(at_s)});
}

TEST(DisturbedVehicle, WhoseEstimateJumpsRejoinsWhereItBelievesToBe) {
  for (const int seed : support::first_at_effort<int>(1, {2, 3})) {
    SCOPED_TRACE(seed);
    const DisturbedFlight flight = jumping(seed, 10, 6);
    EXPECT_EQ(flight.exits(), 1);
    EXPECT_EQ(flight.result().outcome, FlightOutcome::Timeout) << "in truth it hovers 0.6 m beside the goal";
  }
}

TEST(DisturbedVehicle, WhoseEstimateJumpsAmongManyObstaclesTouchesNothing) {
  // These seeds flew on into an obstacle when the tube did not contain the true position.
  for (const int seed : support::first_at_effort<int>(1, {4, 10, 13})) {
    SCOPED_TRACE(seed);
    const DisturbedFlight flight = jumping(seed, 100, 8);
    EXPECT_NE(flight.result().outcome, FlightOutcome::Collision) << flight.result().detail;
  }
}

TEST(DisturbedVehicle, WhoseEstimateJumpsFliesIntoNothingAndWaitsWhereThatLeavesNoWay) {
  // Both are hit while they wait, by a moving obstacle inside the tubes of both places.
  for (const auto& [seed, count, at_s] : support::first_at_effort<std::array<int, 3>>(1, {{1, 10, 6}, {15, 100, 8}})) {
    SCOPED_TRACE(seed);
    const DisturbedFlight flight = jumping(seed, count, at_s);
    EXPECT_EQ(flight.exits(), 1);
    EXPECT_EQ(flight.result().contacts_moving, 0) << flight.result().detail;
  }
}

}  // namespace
}  // namespace tern::testing
