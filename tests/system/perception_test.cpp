// Whole flights among undeclared moving obstacles, seen within 8 m, late, with noise and without ids.
#include <gtest/gtest.h>

#include <fstream>

#include "campaign/virtual_system.h"
#include "core/base/random.h"
#include "messages/channels.h"
#include "simulator/app/simulator_node.h"
#include "tests/support/temp_folder.h"
#include "tests/support/watched_flight.h"

namespace tern::testing {
namespace {

class SandoPerception : public ::testing::TestWithParam<int> {};

TEST_P(SandoPerception, TheForestIsFlownThroughUnharmedByTheDefaults) {
  const VirtualFlight flight = fly_and_expect_all_well("sando_perception", {"seed=" + std::to_string(GetParam())});
  EXPECT_LE(flight.result.stops, 1) << "before anything is known of the movers";
  EXPECT_LT(flight.result.flight_time_s, 27.0);
}

INSTANTIATE_TEST_SUITE_P(Seed, SandoPerception, ::testing::Values(2, 11));

constexpr const char* kBoxInTheWay = R"(
world:
  obstacles: [{centre: [12, 0, 2.5], half_extents: [0.5, 1.5, 2.5]}]
uav:
  start: [9.2, 0, 1.5]
  goal: [25, 0, 1.5]
  flight_box: {min: [-5, -8, 0], max: [32, 8, 5]}
  limits: {v_max: [3, 3, 1.5], a_max: [6, 6, 4]}
simulator:
  declare: false
  sensor: {mode: noisy, dropout: 0}
timeout_s: 20
)";

/// The path to the goal knows no detected obstacle, so the local goal lies behind the box.
TEST(DetectedBox, AVehicleThatStandsInFrontOfItFliesAround) {
  const TempFolder folder;
  std::ofstream(folder.file("box.yaml")) << kBoxInTheWay;
  for (const char* limits : {"uav.limits.v_max=[3, 3, 1.5]", "uav.limits.v_max=[6, 6, 6]"}) {
    const VirtualFlight flight = fly_virtually(folder.file("box.yaml"), {limits});
    EXPECT_EQ(flight.end, "");
    expect_reached(flight.result);
    EXPECT_LT(flight.result.flight_time_s, 10.0) << limits;
  }
}

/// A second sensor that reports only false detections: with each set of the true sensor, somewhere around it.
class FalseAlarms {
 public:
  FalseAlarms(Bus& bus, int per_set) : bus_(bus), per_set_(per_set) {
    bus_.subscribe(channels::kObstacleObservations, [this](const ObservationSet& true_one) {
      if (true_one.sensor_id == kId) return;
      ObservationSet alarms = true_one;
      alarms.sensor_id = kId;
      alarms.detections.clear();
      for (int k = 0; k < per_set_; ++k) alarms.detections.push_back(somewhere(true_one));
      bus_.publish(channels::kObstacleObservations, alarms);
    });
  }

 private:
  static constexpr std::int32_t kId = 9;
  Detection somewhere(const ObservationSet& seen) {
    Detection d;
    const Vec3 way(rng_.uniform(-1, 1), rng_.uniform(-1, 1), rng_.uniform(-0.2, 0.2));
    d.position = seen.sensor_position + seen.range_m * way;
    d.half_extents = Vec3::Constant(0.4);
    d.variance = Vec3::Constant(0.0025);
    d.track_id = kNoTrackId;
    return d;
  }

  Bus& bus_;
  int per_set_;
  Rng rng_{1};
};

TEST(FalseAlarms, NinetyASecondDoNotStopTheVehicle) {
  VirtualSystem system(scenario_file("sando_perception"), {"seed=2"});
  const FalseAlarms alarms(system.runner().observer(), 3);
  const SimulatorNode& simulator = system.simulator();
  system.runner().run(system.runner().now() + Duration{120'000'000}, [&] { return simulator.result().has_value(); });
  ASSERT_TRUE(simulator.result());
  expect_reached(*simulator.result());
  EXPECT_LE(simulator.result()->stops, 1);
  EXPECT_LT(simulator.result()->flight_time_s, 27.0) << "24.7 s without them";
}

}  // namespace
}  // namespace tern::testing
