// A flight through a hall that only a lidar knows: the map is made in flight.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <optional>
#include <vector>

#include "campaign/virtual_system.h"
#include "messages/channels.h"
#include "simulator/app/simulator_node.h"
#include "tests/support/temp_folder.h"

namespace tern {
namespace {

constexpr const char* kHall = R"(
world: {obstacles: []}
uav:
  start: [0, 0, 1.5]
  goal: [24, 0, 1.5]
  flight_box: {min: [-2, -8, 0.2], max: [28, 8, 3.8]}
  limits: {v_max: 3}
  body: {radius: 0.3}
mapper: {live: {enabled: true, max_range_m: 12}}
executor: {tube_m: 0.25}
)";
constexpr double kBodyRadius = 0.3;

/// Two walls from side to side, with a door at opposite ends: no straight way leads through both.
const std::vector<Box> kWalls{Box(Vec3(8.1, -8, 0), Vec3(8.4, 5.1, 4)), Box(Vec3(16.1, -5.1, 0), Vec3(16.4, 8, 4))};

/// Where the ray from p along d enters a wall; nullopt if it meets none.
std::optional<double> distance_along(const Vec3& p, const Vec3& d) {
  std::optional<double> nearest;
  for (const Box& wall : kWalls) {
    const Vec3 first = (wall.min() - p).cwiseQuotient(d);
    const Vec3 second = (wall.max() - p).cwiseQuotient(d);
    const double enter = first.cwiseMin(second).maxCoeff();
    const double leave = first.cwiseMax(second).minCoeff();
    if (enter > 0.0 && enter < leave && (!nearest || enter < *nearest)) nearest = enter;
  }
  return nearest;
}

/// The cloud of a lidar with 360 × 41 beams; beams without a return end far away.
std::vector<CloudScan> scan_from(const Vec3& p, UTime at) {
  std::vector<CloudScan> parts(1);
  for (int i = 0; i < 360; ++i) {
    for (int k = -20; k <= 20; ++k) {
      const double azimuth = (i + 0.5) * std::numbers::pi / 180.0;
      const double elevation = (1.5 * k + 0.5) * std::numbers::pi / 180.0;
      const Vec3 d(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                   std::sin(elevation));
      if (std::ssize(parts.back().points) == kMaxCloudPointsPerMessage) parts.emplace_back();
      parts.back().points.push_back({(d * distance_along(p, d).value_or(1e3)).cast<float>(), 0});
    }
  }
  for (CloudScan& part : parts) {
    part.at = at;
    part.sensor_position = p;
  }
  return parts;
}

TEST(LiveMapFlight, TheVehicleFindsItsWayThroughAHallThatOnlyItsLidarKnows) {
  const TempFolder folder;
  std::ofstream(folder.file("hall.yaml")) << kHall;
  VirtualSystem system(folder.file("hall.yaml"), {});
  VirtualRunner& runner = system.runner();
  Vec3 position(0, 0, 1.5);
  double clearance = 1e9;
  runner.observer().subscribe(channels::kVehicleTruth, [&](const UavState& state) {
    position = state.motion.p;
    for (const Box& wall : kWalls) clearance = std::min(clearance, wall.exteriorDistance(position) - kBodyRadius);
  });
  const SimulatorNode& simulator = system.simulator();
  for (int i = 0; i < 600 && !simulator.result(); ++i) {
    for (const CloudScan& part : scan_from(position, runner.now())) {
      runner.observer().publish(channels::kPointCloud, part);
    }
    runner.run(runner.now() + Duration{100'000}, [&] { return simulator.result().has_value(); });
  }
  ASSERT_TRUE(simulator.result());
  EXPECT_EQ(simulator.result()->outcome, FlightOutcome::Reached) << simulator.result()->detail;
  EXPECT_GT(clearance, 0.0) << "the nearest it came to a wall, m";
  EXPECT_GT(simulator.result()->path_length_m, 26.0) << "through both doors";
}

TEST(LiveMapFlight, WhileTheLidarIsSilentTheVehicleRests) {
  const TempFolder folder;
  std::ofstream(folder.file("hall.yaml")) << kHall;
  VirtualSystem system(folder.file("hall.yaml"), {"timeout_s=90"});
  VirtualRunner& runner = system.runner();
  UavState truth;
  truth.motion.p = Vec3(0, 0, 1.5);
  runner.observer().subscribe(channels::kVehicleTruth, [&](const UavState& state) { truth = state; });
  const SimulatorNode& simulator = system.simulator();
  const auto fly = [&](int scans, bool is_seeing) {
    for (int i = 0; i < scans && !simulator.result(); ++i) {
      for (const CloudScan& part : scan_from(truth.motion.p, runner.now())) {
        if (is_seeing) runner.observer().publish(channels::kPointCloud, part);
      }
      runner.run(runner.now() + Duration{100'000}, [&] { return simulator.result().has_value(); });
    }
  };
  fly(50, true);
  ASSERT_FALSE(simulator.result());
  EXPECT_GT(truth.motion.v.norm(), 0.5) << "on its way";
  fly(80, false);
  ASSERT_FALSE(simulator.result());
  EXPECT_LT(truth.motion.v.norm(), 0.01);
  const Vec3 rested_at = truth.motion.p;
  fly(20, false);
  EXPECT_LT((truth.motion.p - rested_at).norm(), 0.01);
  fly(600, true);
  ASSERT_TRUE(simulator.result());
  EXPECT_EQ(simulator.result()->outcome, FlightOutcome::Reached) << simulator.result()->detail;
}

}  // namespace
}  // namespace tern
