#include "simulator/sensors/sensor.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace tern {
namespace {

const UTime kZero{5'000'000};

World corridor(int count = 100) {
  Scenario s;
  s.world.generator = "paper_corridor";
  s.world.count = count;
  return make_world(s, "").value();
}

TEST(Sensor, TellsTheTruthByDefault) {
  const World world = corridor();
  const SensorConfig config;
  const ObservationSet set = observe(world, config, kZero, 45, Vec3::Zero());
  EXPECT_EQ(set.at, kZero + Duration{1'500'000});
  ASSERT_EQ(set.detections.size(), 100u);
  for (std::size_t i = 0; i < 100; ++i) {
    EXPECT_EQ(set.detections[i].track_id, static_cast<std::int64_t>(i));
    EXPECT_EQ(set.detections[i].position, world.obstacles[i].at(1.5).p);
    EXPECT_EQ(set.detections[i].half_extents, world.obstacles[i].half_extents());
    EXPECT_EQ(set.detections[i].variance, Vec3::Zero());
  }
}

TEST(Sensor, SeesBoxesWhoseNearestPointIsInRange) {
  const World world = corridor();
  SensorConfig config;
  config.range_m = 8.0;
  const Vec3 eye(30, 0, 1);
  const ObservationSet set = observe(world, config, kZero, 30, eye);
  std::size_t expected = 0;
  for (const WorldObstacle& o : world.obstacles) {
    const bool near = o.box(1.0).exteriorDistance(eye) <= 8.0;
    expected += near ? 1 : 0;
    EXPECT_EQ(near, std::any_of(set.detections.begin(), set.detections.end(),
                                [&](const Detection& d) { return d.track_id == o.id(); }));
  }
  EXPECT_EQ(set.detections.size(), expected);
  EXPECT_EQ(set.range_m, 8.0);
  EXPECT_EQ(set.sensor_position, eye);
}

TEST(Sensor, NoiseHasTheStatedDeviationPerAxis) {
  const World world = corridor();
  SensorConfig config;
  config.sigma_m = Vec3(0.05, 0.1, 0.2);
  Vec3 sum = Vec3::Zero();
  Vec3 squares = Vec3::Zero();
  int n = 0;
  for (int k = 0; k < 200; ++k) {
    for (const Detection& d : observe(world, config, kZero, k, Vec3::Zero()).detections) {
      const Vec3 truth =
          world.obstacles[static_cast<std::size_t>(d.track_id)].at((frame_taken(config, kZero, k) - kZero).seconds()).p;
      sum += d.position - truth;
      squares += (d.position - truth).cwiseAbs2();
      EXPECT_EQ(d.variance, Vec3(0.05, 0.1, 0.2).cwiseAbs2());
      ++n;
    }
  }
  ASSERT_EQ(n, 20'000);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(sum[i] / n, 0.0, 4.0 * config.sigma_m[i] / std::sqrt(n));
    EXPECT_NEAR(std::sqrt(squares[i] / n), config.sigma_m[i], 0.02 * config.sigma_m[i]);
  }
}

TEST(Sensor, DropsTheStatedShare) {
  const World world = corridor();
  SensorConfig config;
  config.dropout = 0.05;
  std::size_t seen = 0;
  for (int k = 0; k < 200; ++k) seen += observe(world, config, kZero, k, Vec3::Zero()).detections.size();
  EXPECT_NEAR(static_cast<double>(seen) / 20'000, 0.95, 0.01);
}

TEST(Sensor, WithoutIdsTellsNothingByOrder) {
  SensorConfig config = perception_only(3);
  config.range_m = 0.0;
  const ObservationSet set = observe(corridor(), config, kZero, 7, Vec3::Zero());
  EXPECT_GT(set.detections.size(), 80u);
  for (std::size_t i = 0; i < set.detections.size(); ++i) {
    EXPECT_EQ(set.detections[i].track_id, kNoTrackId);
    if (i > 0) {
      EXPECT_LE(set.detections[i - 1].position.x(), set.detections[i].position.x());
    }
  }
}

TEST(Sensor, IsAFunctionOfSeedAndFrame) {
  const World world = corridor();
  const SensorConfig config = perception_only(3);
  const auto positions = [&](const SensorConfig& c, int frame) {
    std::vector<double> x;
    for (const Detection& d : observe(world, c, kZero, frame, Vec3(20, 0, 1)).detections) x.push_back(d.position.x());
    return x;
  };
  EXPECT_EQ(positions(config, 9), positions(config, 9));
  EXPECT_NE(positions(config, 9), positions(config, 10));
  EXPECT_NE(positions(config, 9), positions(perception_only(4), 9));
}

TEST(Sensor, FramesArriveLate) {
  const SensorConfig config = perception_only(1);
  EXPECT_EQ(frame_taken(config, kZero, 60), kZero + Duration{2'000'000});
  EXPECT_EQ(frame_arrives(config, kZero, 60), kZero + Duration{2'050'000});
}

TEST(Sensor, KeepsTheNearestWhereThereAreTooMany) {
  const World world = corridor();
  SensorConfig config;
  config.max_detections = 10;
  const Vec3 eye(40, 0, 2);
  const ObservationSet set = observe(world, config, kZero, 0, eye);
  ASSERT_EQ(set.detections.size(), 10u);
  double farthest = 0.0;
  for (const Detection& d : set.detections) {
    farthest = std::max(farthest, distance_to_box(eye, d.position, d.half_extents));
  }
  int nearer = 0;
  for (const WorldObstacle& o : world.obstacles) nearer += o.box(0).exteriorDistance(eye) < farthest ? 1 : 0;
  EXPECT_LE(nearer, 10);
}

TEST(Sensor, DoesNotSeeWhoIsAbsent) {
  Scenario s;
  ObstacleSpec o;
  o.motion = WaypointMotion{{{1.0, Vec3::Zero()}, {2.0, Vec3::Ones()}}, false, true};
  s.world.obstacles = {o};
  const World world = make_world(s, "").value();
  EXPECT_EQ(observe(world, {}, kZero, 15, Vec3::Zero()).detections.size(), 0u);
  EXPECT_EQ(observe(world, {}, kZero, 45, Vec3::Zero()).detections.size(), 1u);
}

TEST(Sensor, ThrowsOnAConfigurationOutOfRange) {
  SensorConfig config;
  config.rate_hz = 0.0;
  EXPECT_THROW(observe(World{}, config, kZero, 0, Vec3::Zero()), std::invalid_argument);
  config = {};
  config.dropout = 1.5;
  EXPECT_THROW(observe(World{}, config, kZero, 0, Vec3::Zero()), std::invalid_argument);
}

}  // namespace
}  // namespace tern
