// Whole flights with the simulated autopilot, which behaves as a PX4 with its default gains and limits.
#include <gtest/gtest.h>

#include "tests/support/effort.h"
#include "tests/support/flight_behind_mavlink.h"
#include "tests/support/watched_flight.h"

namespace tern::testing {
namespace {

using mavlink::BridgeConfig;
using mavlink::FlownBehindMavlink;
using mavlink::SimulatedAutopilotConfig;

/// PX4's own simulation of a quadrotor (SIH): thrust/weight 2.04, 1/s of drag.
SimulatedAutopilotConfig sih() {
  SimulatedAutopilotConfig config;
  config.quadrotor.body.thrust_to_weight = 2.04;
  config.quadrotor.body.drag_per_s = config.quadrotor.body.drag_up_per_s = 1.0;
  config.quadrotor.body.drag_per_m = 0.0;
  return config;
}

/// The demo's corridor within the bounds that launcher/flight_processes.h gives an autopilot.
FlownBehindMavlink fly_corridor(int count, int seed, BridgeConfig bridge, const SimulatedAutopilotConfig& autopilot) {
  bridge.set_parameters = bridge.without_remote = true;
  return mavlink::fly_behind_mavlink(
      scenario_file("corridor_demo"),
      {"uav.dynamics={thrust_min: 4, thrust_max: 16, tilt_max: 38, body_rate_max: 170}", "uav.limits.v_max=[6, 6, 1.5]",
       "world.count=" + std::to_string(count), "seed=" + std::to_string(seed)},
      bridge, autopilot);
}

TEST(BehindMavlink, AQuietStartKeepsTheTubeNarrow) {
  for (const int seed : support::first_at_effort<int>(1, {1, 2, 3})) {
    const FlownBehindMavlink flown = fly_corridor(20, seed, {.drag_per_s = 1.0}, sih());
    std::printf("seed %d: tube %.2f error %.2f rmse %.3f exits %ld height %.2f %s\n", seed, flown.widest_tube,
                flown.largest_error, flown.rmse, flown.tube_exits, flown.begun_at_height, flown.why_not.c_str());
    ASSERT_TRUE(flown.result) << flown.why_not;
    expect_reached(*flown.result);
    EXPECT_TRUE(flown.landed);
    EXPECT_NEAR(flown.begun_at_height, 1.0, 0.1);
    EXPECT_LT(flown.widest_tube, 0.5);
    EXPECT_EQ(flown.tube_exits, 0);
  }
}

}  // namespace
}  // namespace tern::testing
