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
FlownBehindMavlink fly_corridor(int count, int seed, const SimulatedAutopilotConfig& autopilot,
                                const std::vector<std::string>& more = {}) {
  std::vector<std::string> overrides{"uav.dynamics={thrust_min: 4, thrust_max: 16, tilt_max: 38, body_rate_max: 170}",
                                     "uav.limits.v_max=[6, 6, 1.5]", "world.count=" + std::to_string(count),
                                     "seed=" + std::to_string(seed)};
  overrides.insert(overrides.end(), more.begin(), more.end());
  const BridgeConfig bridge{.drag_per_s = 1.0, .set_parameters = true, .without_remote = true};
  return mavlink::fly_behind_mavlink(scenario_file("corridor_demo"), overrides, bridge, autopilot);
}

TEST(BehindMavlink, AQuietStartKeepsTheTubeNarrowAndFiftyObstaclesArePassed) {
  for (const int seed : support::first_at_effort<int>(1, {1, 2, 3})) {
    const FlownBehindMavlink flown = fly_corridor(50, seed, sih());
    ASSERT_TRUE(flown.result) << flown.why_not;
    expect_reached(*flown.result);
    EXPECT_TRUE(flown.landed);
    EXPECT_NEAR(flown.begun_at_height, 1.0, 0.1);
    EXPECT_LT(flown.widest_tube, 0.5) << "it grew to 2 m while the tilt was limited, and stayed so";
    EXPECT_LT(flown.rmse, 0.12);
    EXPECT_EQ(flown.tube_exits, 0);
  }
}

/// An estimate like that of GPS: its error is 0.4 m per axis (1 σ), and so is the reported one.
TEST(BehindMavlink, FliesAnEmptyWorldByGps) {
  SimulatedAutopilotConfig gps = sih();
  gps.estimator.position_sigma_m = 0.4;
  gps.estimator.noise_time_s = 20.0;
  const FlownBehindMavlink flown = fly_corridor(
      0, 1, gps,
      {"uav.start=[0, 0, 5]", "uav.goal=[75, 0, 5]", "uav.flight_box={min: [-100, -20, 0], max: [200, 20, 12]}"});
  ASSERT_TRUE(flown.result) << flown.why_not;
  expect_reached(*flown.result);
  EXPECT_TRUE(flown.landed);
}

}  // namespace
}  // namespace tern::testing
