// The sensors of `simulator.sensors` in a running simulator, on virtual time.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "messages/codec.h"
#include "runtime/config.h"
#include "runtime/virtual_runner.h"
#include "simulator/app/make_vehicle.h"
#include "simulator/app/simulator_config.h"
#include "simulator/app/simulator_node.h"
#include "simulator/app/world_broadcast.h"

namespace tern {
namespace {

using ::testing::HasSubstr;

constexpr UTime kStart{1'700'000'000'000'000};

SimulatorConfig config_of(const std::string& keys, std::uint64_t seed = 5) {
  ConfigDocument document = ConfigDocument::parse("simulator: {wait_for: none, " + keys + "}", "test");
  return read_simulator_config(document.root().section("simulator"), seed);
}

template <class Message>
struct Received {
  Message message;
  UTime at;
};

/// All frames of a simulator that runs alone for some seconds.
struct Frames {
  std::vector<Received<SightingSet>> sightings;
  std::vector<Received<ObservationSet>> observations;

  explicit Frames(const std::string& keys, Duration span = Duration{2'000'000}) {
    Scenario scenario;
    scenario.seed = 5;
    scenario.world.generator = "sando_forest";
    scenario.world.count = 200;
    scenario.uav.start = Vec3(0, 0, 2);
    scenario.uav.goal = Vec3(105, 0, 2);
    const SimulatorConfig config = config_of(keys);
    VirtualRunner runner(kStart);
    Bus& ear = runner.observer();
    ear.subscribe(channels::kObstacleSightings, [&](const SightingSet& m) { sightings.push_back({m, runner.now()}); });
    ear.subscribe(channels::kObstacleObservations, [&](const ObservationSet& m) {
      observations.push_back({m, runner.now()});
    });
    runner.start("tern-simulator", [&](Bus& bus) -> std::unique_ptr<Node> {
      auto vehicle = make_vehicle(scenario, config, bus.clock().now());
      return std::make_unique<SimulatorNode>(bus, scenario, make_world(scenario, "").value(), std::move(vehicle),
                                             config);
    });
    runner.run(kStart + span);
  }
};

TEST(SensorBroadcast, SendsEachSensorAtItsRateAndLatency) {
  const Frames frames("declare: false, sensors: [{type: camera}, {type: camera, yaw_deg: 40}, {type: lidar}]");
  EXPECT_TRUE(frames.observations.empty());
  std::vector<int> of(3);
  for (const auto& [set, at] : frames.sightings) {
    ASSERT_LT(set.sensor_id, 3);
    ++of[idx(set.sensor_id)];
    EXPECT_EQ(at - set.at, (Duration{set.sensor_id == 2 ? 100'000 : 50'000}));
    EXPECT_EQ(set.view.kind, set.sensor_id == 2 ? ViewKind::Spherical : ViewKind::Pinhole);
    EXPECT_EQ(set.view.range_m, set.sensor_id == 2 ? 20.0 : 10.0);
  }
  EXPECT_NEAR(of[0], 59, 1);
  EXPECT_NEAR(of[1], 59, 1);
  EXPECT_NEAR(of[2], 19, 1);
  EXPECT_GT(frames.sightings.back().message.sightings.size(), 3u);
}

TEST(SensorBroadcast, SeesTheSameInEveryRun) {
  const std::string keys = "declare: false, sensors: [{type: camera, noise_block: 5, mount: body}]";
  const Frames first(keys), second(keys);
  ASSERT_EQ(first.sightings.size(), second.sightings.size());
  for (std::size_t k = 0; k < first.sightings.size(); ++k) {
    EXPECT_EQ(first.sightings[k].message.view.depths, second.sightings[k].message.view.depths);
    EXPECT_EQ(first.sightings[k].message.sightings.size(), second.sightings[k].message.sightings.size());
  }
}

TEST(SensorBroadcast, MeasuresTheSameByNearAsByTheOnlySensor) {
  const Frames listed("declare: false, sensors: [{type: near}]"), only("declare: false, sensor: {mode: noisy}");
  ASSERT_EQ(listed.observations.size(), only.observations.size());
  for (std::size_t k = 0; k < only.observations.size(); ++k) {
    const auto& [a, a_at] = listed.observations[k];
    const auto& [b, b_at] = only.observations[k];
    EXPECT_EQ(a_at, b_at);
    ASSERT_EQ(a.detections.size(), b.detections.size());
    for (std::size_t d = 0; d < a.detections.size(); ++d) EXPECT_EQ(a.detections[d].position, b.detections[d].position);
  }
}

TEST(SensorBroadcast, SeesMoversAtRestBeforeADeclaredWorldBegins) {
  const Frames frames("sensors: [{type: lidar, sigma_m: 0}]", Duration{250'000});
  ASSERT_EQ(frames.sightings.size(), 2u);
  EXPECT_EQ(frames.sightings[0].message.view.depths, frames.sightings[1].message.view.depths);
}

std::string refusal(const std::string& keys) {
  try {
    config_of(keys);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(SensorBroadcast, RefusesSensorsThatCannotBe) {
  EXPECT_THAT(refusal("sensors: [{type: sonar}]"), HasSubstr("camera, lidar, near, truth"));
  EXPECT_THAT(refusal("sensors: [{type: camera, range_m: 0.1}]"), HasSubstr("must be above least_range_m"));
  EXPECT_THAT(refusal("sensors: [{type: camera, dropout: 0.1}]"), HasSubstr("dropout"));
  EXPECT_THAT(refusal("sensors: [{type: near, columns: 9}]"), HasSubstr("columns"));
  EXPECT_THAT(refusal("sensors: [{type: lidar, elevation_min_deg: 3}]"), HasSubstr("elevation_min_deg"));
  EXPECT_THAT(refusal("sensors: [{type: camera, yaw_deg: 270}]"), HasSubstr("yaw_deg"));
}

TEST(SensorBroadcast, RefusesAGroundAboveTheStart) {
  Scenario scenario;
  const SimulatorConfig config = config_of("sensors: [{type: camera}], ground_z: 1.5");
  EXPECT_THROW(flyable_world_of(scenario, config), ConfigError);
  EXPECT_NO_THROW(flyable_world_of(scenario, config_of("sensors: [{type: camera}], ground_z: 1.5, ground: none")));
}

TEST(FlyableWorld, WithAnEstimateAFlightBoxBelowTheGroundIsRemarkedOn) {
  Scenario scenario;
  SimulatorConfig config;
  const auto remarks = [&] { return flyable_world_of(scenario, config).remarks; };
  EXPECT_TRUE(remarks().empty()) << "nobody estimates";
  config.vio.emplace();
  ASSERT_EQ(remarks().size(), 1U);
  EXPECT_NE(remarks()[0].find("below the ground"), std::string::npos);
  scenario.uav.flight_box.min().z() = 0.0;
  EXPECT_TRUE(remarks().empty());
}

}  // namespace
}  // namespace tern
