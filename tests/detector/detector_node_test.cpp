// tern-detector: images and clouds in, sightings out.
#include "detector/app/detector_node.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <set>
#include <vector>

#include "messages/codec.h"
#include "perception/view.h"
#include "runtime/virtual_runner.h"
#include "tests/perception/scene.h"
#include "tests/support/voxel_maps.h"

namespace tern {
namespace {

using support::Scene;
using ::testing::HasSubstr;

const Box kBox(Vec3(4, -0.5, 0.6), Vec3(5, 0.7, 1.6));

class DetectorNodeTest : public ::testing::Test {
 protected:
  DetectorNodeTest() : scene_(optics()) {
    node_ =
        &runner_.start("tern-detector", [](Bus& bus) { return std::make_unique<DetectorNode>(bus, DetectorConfig{}); });
    runner_.observer().subscribe(channels::kObstacleSightings, [this](const SightingSet& s) { frames_.push_back(s); });
  }
  static DepthSensor optics() {
    DepthSensor sensor;
    sensor.shape = camera_shape(1.2, 0.95, 160, 120);
    sensor.noise = {0.0, 0.0025, 1};
    return sensor;
  }
  void run(double seconds) { runner_.run(runner_.now() + Duration::from_seconds(seconds)); }
  /// Renders the box from x, and sends the image in two parts.
  void send_image(double x, std::int32_t sensor = 3) {
    scene_.render(looking(Vec3(x, 0, 1), 0.0), {kBox}, 0.0, ++frame_);
    send(support::depth_images(scene_.picture, 50), sensor);
  }
  void send(std::vector<DepthImage> parts, std::int32_t sensor = 3) {
    for (DepthImage& part : parts) {
      part.at = runner_.now();
      part.sensor_id = sensor;
      runner_.observer().publish(channels::kDepthImage, part);
    }
  }

  VirtualRunner runner_;
  Scene scene_;
  int frame_ = 0;
  const Node* node_ = nullptr;
  std::vector<SightingSet> frames_;
};

TEST_F(DetectorNodeTest, FindsTheBoxAndNotTheGround) {
  EXPECT_THAT(node_->health().waiting_for, HasSubstr("a scan on DEPTH_IMAGE or POINT_CLOUD"));
  run(0.1);
  const UTime at = runner_.now();
  send_image(0.0);
  run(0.1);
  ASSERT_EQ(frames_.size(), 1u);
  EXPECT_EQ(frames_[0].at, at);
  EXPECT_EQ(frames_[0].sensor_id, 3);
  EXPECT_GT(frames_[0].view.depths.size(), 100u);
  ASSERT_EQ(frames_[0].sightings.size(), 1u);
  const Sighting& box = frames_[0].sightings[0];
  EXPECT_EQ(box.bounds[0], BoundSight::Face);
  EXPECT_NEAR(box.lower.x(), 4.0, 0.05);
  EXPECT_NEAR(box.upper.y(), 0.7, 0.1);
  EXPECT_EQ(node_->health().waiting_for, "");
}

TEST_F(DetectorNodeTest, KnowsFromTheSecondImageOnHowManyRowsThereAre) {
  send_image(0.0);
  run(0.1);
  send_image(0.0);
  run(0.01);
  EXPECT_EQ(frames_.size(), 2u) << "within the time in which further rows would have been awaited";
}

TEST_F(DetectorNodeTest, AnImageWhoseRestIsLostIsUsedAsFarAsItCame) {
  scene_.render(looking(Vec3(0, 0, 1), 0.0), {kBox}, 0.0);
  auto parts = support::depth_images(scene_.picture, 100);
  parts.pop_back();
  send(parts);
  run(0.1);
  ASSERT_EQ(frames_.size(), 1u);
  EXPECT_EQ(frames_[0].sightings.size(), 1u);
}

TEST_F(DetectorNodeTest, ADepthThatIsAllZerosIsNamed) {
  send_image(0.0);
  auto parts = support::depth_images(scene_.picture, 50);
  run(0.1);
  for (DepthImage& part : parts) part.depths.assign(part.depths.size(), 0);
  send(parts);
  run(0.1);
  EXPECT_EQ(frames_.size(), 1u);
  EXPECT_THAT(node_->health().waiting_for, HasSubstr("sensor 3: no pixel measured a depth"));
  run(6.0);
  send_image(0.0);
  run(0.1);
  EXPECT_EQ(node_->health().waiting_for, "");
}

TEST_F(DetectorNodeTest, ADepthThatIsAllNaNIsNamed) {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  CloudScan scan;
  scan.at = runner_.now();
  scan.sensor_id = 4;
  scan.sensor_position = Vec3(0, 0, 1);
  scan.points.assign(500, {Eigen::Vector3f::Constant(kNaN), 0});
  runner_.observer().publish(channels::kPointCloud, scan);
  run(0.1);
  EXPECT_TRUE(frames_.empty());
  EXPECT_THAT(node_->health().waiting_for, HasSubstr("sensor 4"));
  send_image(0.0);
  run(0.1);
  EXPECT_EQ(frames_.size(), 1u) << "another sensor goes on";
}

// The lowest rows show the vehicle's own landing gear, 0.1 m away: that is no obstacle, and hides what is behind it.
TEST_F(DetectorNodeTest, ASensorThatCoversItselfSeesNeitherAnObstacleNorFreeSpaceThere) {
  scene_.render(looking(Vec3(0, 0, 1), 0.0), {kBox}, 0.0);
  auto parts = support::depth_images(scene_.picture, 90);
  std::ranges::fill(parts[1].depths, std::int16_t{100});
  send(parts);
  run(0.1);
  ASSERT_EQ(frames_.size(), 1u);
  ASSERT_EQ(frames_[0].sightings.size(), 1u);
  EXPECT_NEAR(frames_[0].sightings[0].lower.x(), 4.0, 0.05);
  EXPECT_EQ(looked_at(frames_[0].view, Vec3(2.0, 0.0, 1.3)), Looked::Through);
  EXPECT_EQ(looked_at(frames_[0].view, Vec3(2.0, 0.0, 0.3)), Looked::OutOfView);
}

TEST_F(DetectorNodeTest, ACameraThatFreezesInFlightIsNamedAndNotUsed) {
  send_image(0.0);
  run(0.1);
  auto frozen = support::depth_images(scene_.picture, 50);
  send(frozen);
  run(0.1);
  EXPECT_EQ(frames_.size(), 2u) << "a camera without noise, at rest, sends this as well";
  for (DepthImage& part : frozen) part.sensor_position.x() += 0.5;
  send(frozen);
  run(0.1);
  EXPECT_EQ(frames_.size(), 2u);
  EXPECT_THAT(node_->health().waiting_for, HasSubstr("sensor 3 is frozen"));
}

TEST_F(DetectorNodeTest, ALidarThatFreezesInFlightIsNamedAndNotUsed) {
  scene_.render(looking(Vec3(0, 0, 1), 0.0), {kBox}, 0.0);
  CloudScan scan;
  scan.sensor_id = 4;
  scan.sensor_position = Vec3(0, 0, 1);
  for (int pixel = 0; pixel < scene_.picture.shape().pixels(); pixel += 5) {
    if (!scene_.picture.is_surface(pixel)) continue;
    scan.points.push_back({scene_.picture.at_depth(pixel, scene_.picture.depths()[pixel]), 0});
  }
  for (int k = 0; k < 2; ++k) {
    scan.at = runner_.now();
    runner_.observer().publish(channels::kPointCloud, scan);
    run(0.1);
    scan.sensor_position.x() += 0.5;
  }
  EXPECT_EQ(frames_.size(), 1u);
  EXPECT_THAT(node_->health().waiting_for, HasSubstr("sensor 4 is frozen"));
}

TEST_F(DetectorNodeTest, AnEmptyFieldIsNoFrozenCamera) {
  scene_.render(looking(Vec3(0, 0, 30), 0.0), {});
  auto empty = support::depth_images(scene_.picture, 50);
  for (DepthImage& part : empty) std::ranges::fill(part.depths, std::numeric_limits<std::int16_t>::max());
  for (int k = 0; k < 5; ++k) {
    send(empty);
    run(0.1);
    for (DepthImage& part : empty) part.sensor_position.x() += 0.5;
  }
  EXPECT_EQ(frames_.size(), 5u);
  EXPECT_EQ(node_->health().waiting_for, "");
}

TEST_F(DetectorNodeTest, AnImageThatNoMemoryHoldsIsNamedAndCostsNothing) {
  DepthImage lie;
  lie.width = 28'800;
  lie.first_row = 1'000'000;
  lie.depths.assign(28'800, 1'000);
  send({lie});
  run(0.1);
  EXPECT_THAT(node_->health().waiting_for, HasSubstr("sensor 3: 28800 × 1000001 pixels are too many"));
  lie.width = 1;
  lie.first_row = 900'000;
  lie.depths.resize(20'000);
  send({lie});
  run(0.1);
  EXPECT_THAT(node_->health().waiting_for, HasSubstr("1 × 920000 pixels are too many"));
  EXPECT_TRUE(frames_.empty());
  send_image(0.0);
  run(0.1);
  EXPECT_EQ(frames_.size(), 1u) << "it goes on";
}

TEST_F(DetectorNodeTest, ASensorThatMeasuresNothingBeyondTheLeastRangeIsNamed) {
  scene_.render(looking(Vec3(0, 0, 1), 0.0), {kBox}, 0.0);
  auto parts = support::depth_images(scene_.picture, 50);
  for (DepthImage& part : parts) part.range_m = 0.1;
  send(parts);
  run(0.1);
  EXPECT_TRUE(frames_.empty());
  EXPECT_THAT(node_->health().waiting_for, HasSubstr("its range of 0.1 m is not beyond the least range of 0.2 m"));
}

TEST(ScanParts, AnEndlessMeasurementIsRefusedAtItsLimit) {
  ScanParts<CloudScan> parts;
  CloudScan scan;
  scan.points.resize(kMaxCloudPointsPerMessage);
  const int fits = static_cast<int>(ScanParts<CloudScan>::kMaxValues / scan.points.size());
  for (int k = 0; k < fits; ++k) EXPECT_TRUE(parts.add(scan, UTime{k}));
  EXPECT_FALSE(parts.add(scan, UTime{fits}));
  ASSERT_EQ(parts.take(UTime{fits} + Duration{60'000}).size(), 1u);
  scan.at = UTime{1};
  EXPECT_TRUE(parts.add(scan, UTime{200'000}));
}

TEST(ScanParts, ASensorThatIsSilentGivesItsPlaceToAnother) {
  ScanParts<CloudScan> parts;
  CloudScan scan;
  scan.points.resize(1);
  for (std::size_t k = 0; k < ScanParts<CloudScan>::kMaxSensors; ++k) {
    scan.sensor_id = static_cast<std::int32_t>(k);
    EXPECT_TRUE(parts.add(scan, UTime{0}));
  }
  scan.sensor_id = 0;
  EXPECT_TRUE(parts.add(scan, UTime{4'000'000}));
  scan.sensor_id = 100;
  EXPECT_FALSE(parts.add(scan, UTime{4'000'000}));
  EXPECT_TRUE(parts.add(scan, UTime{5'000'001}));
  EXPECT_EQ(parts.take(UTime{5'060'000}).size(), 2u) << "the others are forgotten";
}

TEST_F(DetectorNodeTest, MoreSensorsThanItHandlesAreNamed) {
  for (int sensor = 0; sensor < 17; ++sensor) send_image(0.0, 100 + sensor);
  run(0.1);
  EXPECT_THAT(node_->health().waiting_for, HasSubstr("DEPTH_IMAGE is refused: more than 16 sensors"));
}

TEST_F(DetectorNodeTest, APersonBeyondAFenceIsSighted) {
  VoxelMap map = support::free_map({24, 8, 8});
  map.class_names = {"", "fence"};
  support::paint(map, {12, 0, 0}, {23, 7, 7}, VoxelLabel::Occupied);
  for (std::size_t i = 0; i < map.labels.size(); ++i) map.classes[i] = map.labels[i] == VoxelLabel::Occupied ? 1 : 0;
  map.version = map.compute_version();
  for (const MapChunk& chunk : to_chunks(map)) runner_.observer().publish(channels::kSemanticMap, chunk);
  run(0.1);
  scene_.render(looking(Vec3(0, 1, 1), 0.0), {Box(Vec3(4.1, 0.7, 0.1), Vec3(4.6, 1.3, 1.8))}, 0.0);
  send(support::depth_images(scene_.picture, 50));
  run(0.1);
  ASSERT_EQ(frames_.size(), 1u);
  EXPECT_EQ(frames_[0].sightings.size(), 1u);
}

// A person half a metre before a wall, as a lidar without noise sees them from 16 m.
TEST_F(DetectorNodeTest, ALidarSeesAPersonBeforeAWall) {
  DepthSensor lidar;
  lidar.shape = lidar_shape(6.283185307179586, -1.5707963267948966, 1.5707963267948966, 360, 180);
  lidar.range_m = 40.0;
  lidar.noise = {0.0, 0.0, 1};
  Scene scene(lidar);
  const Box person(Vec3(16.0, -0.6, 0.0), Vec3(16.4, 0.6, 2.0)), wall(Vec3(17.0, -9, 0), Vec3(17.5, 9, 5));
  scene.render(looking(Vec3(0, 0, 1), 0.0), {person, wall});
  CloudScan scan;
  scan.at = runner_.now();
  scan.sensor_id = 4;
  scan.sensor_position = Vec3(0, 0, 1);
  for (int pixel = 0; pixel < scene.picture.shape().pixels(); ++pixel) {
    if (!scene.picture.is_surface(pixel)) continue;
    scan.points.push_back({scene.picture.at_depth(pixel, scene.picture.depths()[pixel]), 0});
  }
  ASSERT_LE(scan.points.size(), std::size_t{kMaxCloudPointsPerMessage});
  runner_.observer().publish(channels::kPointCloud, scan);
  run(0.1);
  ASSERT_EQ(frames_.size(), 1u);
  EXPECT_TRUE(std::ranges::any_of(frames_[0].sightings,
                                  [](const Sighting& s) { return s.lower.x() > 15.5 && s.upper.x() < 16.9; }));
}

TEST_F(DetectorNodeTest, PointsOnTheMapAreNoSightings) {
  VoxelMap map = support::free_map({24, 8, 8});
  support::paint(map, {16, 0, 0}, {19, 7, 7}, VoxelLabel::Occupied);  // x from 4 to 5 m
  for (const MapChunk& chunk : to_chunks(map)) runner_.observer().publish(channels::kSemanticMap, chunk);
  run(0.1);
  const Box wall(Vec3(4.1, 0.2, 0.3), Vec3(4.9, 1.8, 1.7));
  scene_.render(looking(Vec3(0, 1, 1), 0.0), {wall}, 0.0);
  send(support::depth_images(scene_.picture, 50));
  run(0.1);
  ASSERT_EQ(frames_.size(), 1u);
  EXPECT_TRUE(frames_[0].sightings.empty());
}

TEST_F(DetectorNodeTest, APointCloudIsDetectedInAsWell) {
  scene_.render(looking(Vec3(0, 0, 1), 0.0), {kBox}, 0.0);
  CloudScan scan;
  scan.at = runner_.now();
  scan.sensor_id = 4;
  scan.sensor_position = Vec3(0, 0, 1);
  for (int pixel = 0; pixel < 4'000; ++pixel) {
    const int k = pixel * scene_.picture.shape().pixels() / 4'000;
    if (scene_.picture.is_surface(k))
      scan.points.push_back({scene_.picture.at_depth(k, scene_.picture.depths()[k]), 0});
  }
  runner_.observer().publish(channels::kPointCloud, scan);
  run(0.1);
  ASSERT_EQ(frames_.size(), 1u);
  EXPECT_EQ(frames_[0].sensor_id, 4);
  EXPECT_GE(frames_[0].sightings.size(), 1u);
}

TEST_F(DetectorNodeTest, OfAFloodTheNewestImageOfEachSensorIsUsedAndTheRestCounted) {
  for (int k = 0; k < 40; ++k) {
    send_image(0.0, k % 2);
    runner_.run(runner_.now() + Duration{100});
  }
  run(0.2);
  EXPECT_LE(frames_.size(), 40u);
  EXPECT_GE(frames_.size(), 4u);
  for (int sensor = 0; sensor < 30; ++sensor) send_image(0.0, 100 + sensor);
  run(0.1);
  std::set<std::int32_t> sensors;
  for (const SightingSet& frame : frames_) sensors.insert(frame.sensor_id);
  EXPECT_LE(sensors.size(), ScanParts<DepthImage>::kMaxSensors);
}

}  // namespace
}  // namespace tern
