// Vehicles that are slower, or hold longer, than predictions reach: they take smaller steps, and arrive.
#include <gtest/gtest.h>

#include "core/wire/message_limits.h"
#include "tests/support/watched_flight.h"

namespace tern::testing {
namespace {

constexpr char kNobody[] = "world={generator: none}";
constexpr char kFarMover[] =
    "world={generator: none, obstacles: [{motion: linear, centre: [700, 0, 1], velocity: [1, 0, 0]}]}";
constexpr char kMoverBeside[] =
    "world={generator: none, obstacles: [{motion: wave, centre: [1, 4.5, 1], amplitude: [3, 0, 0]}]}";

std::vector<std::string> hop(double metres, const std::string& v_max, const std::string& world) {
  return {world, "uav.start=[0, 0, 1]", "uav.goal=[" + std::to_string(metres) + ", 0, 1]", "uav.limits.v_max=" + v_max,
          "executor.rate_hz=5"};
}

TEST(SlowVehicle, IsNotHeldUpByWhatMovesFarAway) {
  fly_and_expect_all_well("paper_corridor", hop(10.0, "0.5", kFarMover));
}

TEST(SlowVehicle, FliesBesideWhatMovesWithinItsSphere) {
  for (const char* v_max : {"0.05", "0.2", "0.6"}) {
    SCOPED_TRACE(v_max);
    fly_and_expect_all_well("paper_corridor", hop(1.5, v_max, kMoverBeside));
  }
}

TEST(SlowVehicle, SendsNoPlanThatTheExecutorRefuses) {
  for (const char* v_max : {"0.01", "0.05"}) {
    SCOPED_TRACE(v_max);
    Exchange exchange;
    auto overrides = hop(1.0, v_max, kNobody);
    overrides.emplace_back("executor.rate_hz=1");
    const VirtualFlight flight = fly_virtually(scenario_file("paper_corridor"), overrides, &exchange);
    expect_reached(flight.result);
    expect_answered_once_and_in_time(flight.executor, exchange);
    for (const Plan& plan : exchange.plans) EXPECT_LE(plan.trajectory.interval, kMaxIntervalDuration);
  }
}

TEST(SlowVehicle, GetsOnThroughThePapersCorridor) {
  const VirtualFlight flight = fly_virtually(scenario_file("paper_corridor"),
                                             {"seed=1", "uav.limits.v_max=0.6", "timeout_s=60", "executor.rate_hz=10"});
  EXPECT_GT(flight.result.path_length_m, 20.0);
  EXPECT_EQ(flight.executor.refused(), 0);
}

TEST(GentleVehicle, FliesWhateverOfItsLimitsIsTheLeast) {
  for (const char* limits :
       {"{v_max: 0.05, a_max: 0.05}", "{v_max: 2, a_max: 0.02}", "{v_max: 2, a_max: 5, j_max: 0.01}",
        "{v_max: 1000, a_max: 10000, j_max: 0.001}", "{v_max: 0.001, a_max: 0.001, j_max: 0.001}"}) {
    for (const char* world : {kNobody, kFarMover}) {
      SCOPED_TRACE(std::string(limits) + " " + world);
      auto overrides = hop(0.3, "1", world);
      overrides.emplace_back(std::string("uav.limits=") + limits);
      overrides.emplace_back("executor.rate_hz=1");
      fly_and_expect_all_well("paper_corridor", overrides);
    }
  }
}

TEST(LongHold, ThatNoHorizonCanGiveDoesNotKeepTheVehicleAtRest) {
  auto overrides = hop(20.0, "6", kMoverBeside);
  overrides.emplace_back("planner.hold_required_s=10");
  overrides.emplace_back("planner.hold_cap_s=10");
  fly_and_expect_all_well("paper_corridor", overrides);
}

}  // namespace
}  // namespace tern::testing
