#include "simulator/sensors/depth_sensor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/world/vehicle.h"
#include "simulator/vehicle/attitude.h"

namespace tern {
namespace {

constexpr double kPi = std::numbers::pi;
const Vec3 kPlace(10, -3, 2);

/// The direction in which a sensor looks, W.
Vec3 axis(const SensorPose& pose) { return pose.q_WC * Vec3::UnitZ(); }

TEST(DepthSensor, IsLevelOnAGimbalAndTiltsWithTheBody) {
  const Eigen::Quaterniond forwards = attitude_of(Vec3(kGravity, 0, 0), 0.0);  // 45° nose down
  DepthSensorConfig config = default_camera();
  EXPECT_NEAR(axis(mounted(config, kPlace, forwards)).z(), 0.0, 1e-12);
  config.on_gimbal = false;
  EXPECT_NEAR(axis(mounted(config, kPlace, forwards)).z(), -std::sqrt(0.5), 1e-12);
  config.pitch = kPi / 4;
  EXPECT_NEAR(axis(mounted(config, kPlace, forwards)).z(), 0.0, 1e-12);
}

TEST(DepthSensor, TurnsWithTheHeadingAndItsMount) {
  const Eigen::Quaterniond north = attitude_of(Vec3::Zero(), kPi / 2);
  DepthSensorConfig config = default_camera();
  config.yaw = 40.0 * kPi / 180.0;
  config.position = Vec3(0.2, 0.1, 0.05);
  const SensorPose pose = mounted(config, kPlace, north);
  EXPECT_NEAR(std::atan2(axis(pose).y(), axis(pose).x()), kPi / 2 + config.yaw, 1e-12);
  EXPECT_TRUE(pose.position.isApprox(kPlace + Vec3(-0.1, 0.2, 0.05), 1e-12)) << pose.position.transpose();
}

TEST(DepthSensor, TiltsByTheAccelerationAtEveryHeading) {
  for (double yaw = -3.0; yaw <= 3.0; yaw += 0.5) {
    const Vec3 acceleration(3, -2, 1);
    const Eigen::Quaterniond q = attitude_of(acceleration, yaw);
    const Vec3 up = q * Vec3::UnitZ(), ahead = q * Vec3::UnitX();
    EXPECT_TRUE(up.isApprox((acceleration + Vec3(0, 0, kGravity)).normalized(), 1e-12));
    EXPECT_NEAR(std::atan2(ahead.y(), ahead.x()), yaw, 1e-12);
  }
}

bool same(const SightingSet& a, const SightingSet& b) {
  const auto equal = [](const Sighting& s, const Sighting& t) { return s.lower == t.lower && s.upper == t.upper; };
  return a.view.depths == b.view.depths && std::ranges::equal(a.sightings, b.sightings, equal);
}

TEST(DepthSensor, MakesFramesThatAreFunctionsOfTheirArgumentsAndTheSeed) {
  const std::vector<Box> boxes = {Box(Vec3(4, -1, 0), Vec3(5, 0, 2)), Box(Vec3(7, 1, 0), Vec3(8, 2, 3))};
  const TrueSurfaces surfaces{boxes, {}, 0.0};
  const SensorPose pose = looking(Vec3(0, 0, 1), 0.0);
  SimulatedDepthSensor sensor(default_camera(), 0, 7), other(default_camera(), 0, 7), seeded(default_camera(), 0, 8);
  const SightingSet third = sensor.look(surfaces, pose, pose, UTime{100}, 3);
  EXPECT_EQ(third.sightings.size(), 2u);
  other.look(surfaces, pose, pose, UTime{70}, 2);
  EXPECT_TRUE(same(third, other.look(surfaces, pose, pose, UTime{100}, 3)));
  EXPECT_FALSE(same(third, other.look(surfaces, pose, pose, UTime{100}, 4)));
  EXPECT_FALSE(same(third, seeded.look(surfaces, pose, pose, UTime{100}, 3)));
}

TEST(DepthSensor, HidesFarThingsBehindNearOnes) {
  const std::vector<Box> boxes = {Box(Vec3(3, -3, 0), Vec3(3.2, 3, 3)), Box(Vec3(6, -1, 0), Vec3(7, 1, 2))};
  const std::vector<Box> map = {Box(Vec3(5, -3, 0), Vec3(5.5, 3, 3))};
  const SensorPose pose = looking(Vec3(0, 0, 1), 0.0);
  SimulatedDepthSensor sensor(default_camera(), 0, 1);
  EXPECT_EQ(sensor.look({boxes, {}, {}}, pose, pose, UTime{1}, 0).sightings.size(), 1u);
  // A wall of the map hides as well, and is no sighting itself.
  EXPECT_TRUE(sensor.look({std::span(boxes).subspan(1), map, 0.0}, pose, pose, UTime{1}, 0).sightings.empty());
}

TEST(DepthSensor, PutsThingsWhereTheVehicleBelievesToSeeThem) {
  const std::vector<Box> boxes = {Box(Vec3(4, -1, 0.5), Vec3(5, 0, 2))};
  const SensorPose pose = looking(Vec3(0, 0, 1), 0.0), believed = looking(Vec3(0.5, -0.2, 1.1), 0.0);
  SimulatedDepthSensor sensor(default_camera(), 0, 1);
  const SightingSet right = sensor.look({boxes, {}, {}}, pose, pose, UTime{1}, 0);
  const SightingSet moved = sensor.look({boxes, {}, {}}, pose, believed, UTime{1}, 0);
  ASSERT_EQ(right.sightings.size(), 1u);
  ASSERT_EQ(moved.sightings.size(), 1u);
  EXPECT_TRUE((moved.sightings[0].lower - right.sightings[0].lower).isApprox(Vec3(0.5, -0.2, 0.1), 1e-4));
  EXPECT_EQ(moved.view.sensor_position, believed.position);
}

}  // namespace
}  // namespace tern
