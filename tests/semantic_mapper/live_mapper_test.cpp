// tern-mapper with a live map: scans in, versions of the map out.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "runtime/virtual_runner.h"
#include "semantic_mapper/app/live_intake.h"
#include "semantic_mapper/app/mapper_node.h"
#include "tests/support/cloud_files.h"
#include "tests/support/voxel_maps.h"

namespace tern {
namespace {

using testing::HasSubstr;

/// A live mapper over 40 × 40 × 8 unknown voxels of 0.25 m, and a test that receives its maps.
class LiveMapperTest : public ::testing::Test {
 protected:
  LiveMapperTest() {
    VoxelMap base = support::free_map({40, 40, 8});
    std::fill(base.labels.begin(), base.labels.end(), VoxelLabel::Unknown);
    base.version = base.compute_version();
    LiveSetup setup;
    setup.period = Duration{500'000};
    setup.body.vertices = Points::Zero(3, 1);
    setup.body.radius = 0.3;
    setup.position = Vec3(1, 5, 1);
    node_ = &runner_.start("tern-mapper", [&](Bus& bus) { return std::make_unique<MapperNode>(bus, base, setup); });
    runner_.observer().subscribe(channels::kSemanticMap, [this](const MapChunk& chunk) {
      const auto done = assembler_.add(chunk);
      ASSERT_TRUE(done) << done.error().message;
      if (*done) maps_.push_back({runner_.now(), assembler_.take()});
    });
  }

  void run(double seconds) { runner_.run(runner_.now() + Duration::from_seconds(seconds)); }

  /// A wall across x, seen from (1, 5, 1).
  [[nodiscard]] CloudScan wall(double x) const {
    CloudScan scan;
    scan.at = runner_.now();
    scan.sensor_position = Vec3(1, 5, 1);
    for (double y = 3.1; y < 7.0; y += 0.1) {
      for (double z = 0.1; z < 2.0; z += 0.1) {
        scan.points.push_back({(Vec3(x, y, z) - scan.sensor_position).cast<float>(), 0});
      }
    }
    return scan;
  }
  [[nodiscard]] VoxelLabel label_at(const Vec3& p) const {
    const VoxelMap& map = maps_.back().map;
    return map.labels[idx(map.grid.index(map.grid.cell_of(p)))];
  }

  struct Arrival {
    UTime at;
    VoxelMap map;
  };
  VirtualRunner runner_;
  const Node* node_ = nullptr;
  MapAssembler assembler_;
  std::vector<Arrival> maps_;
};

TEST_F(LiveMapperTest, ACloudBecomesOccupiedAndFreeVoxels) {
  run(0.1);
  EXPECT_EQ(node_->health().state, ProcessState::Waiting);
  EXPECT_THAT(node_->health().waiting_for, HasSubstr("a scan on POINT_CLOUD or DEPTH_IMAGE"));
  EXPECT_TRUE(maps_.empty()) << "receivers keep the map of the process before";
  for (int i = 0; i < 3; ++i) {
    runner_.observer().publish(channels::kPointCloud, wall(6.1));
    run(0.1);
  }
  EXPECT_EQ(node_->health().state, ProcessState::Ready);
  run(0.6);
  ASSERT_FALSE(maps_.empty());
  EXPECT_EQ(label_at({6.1, 5, 1}), VoxelLabel::Occupied);
  EXPECT_EQ(label_at({4, 5, 1}), VoxelLabel::Free);
  EXPECT_EQ(label_at({8, 5, 1}), VoxelLabel::Unknown);
  const std::size_t versions = maps_.size();
  run(1.9);
  EXPECT_EQ(maps_.size(), versions) << "without a change there is no version";
  EXPECT_THAT(node_->health().waiting_for, HasSubstr("scans: the last usable one came"));
}

TEST_F(LiveMapperTest, WhatGoesAwayIsFreedWithinTwoSecondsOfScans) {
  for (int i = 0; i < 50; ++i) {
    runner_.observer().publish(channels::kPointCloud, wall(4.1));
    run(0.1);
  }
  ASSERT_EQ(label_at({4.1, 5, 1}), VoxelLabel::Occupied);
  for (int i = 0; i < 20; ++i) {
    runner_.observer().publish(channels::kPointCloud, wall(8.1));
    run(0.1);
  }
  EXPECT_EQ(label_at({4.1, 5, 1}), VoxelLabel::Free);
  EXPECT_EQ(label_at({8.1, 5, 1}), VoxelLabel::Occupied);
  for (std::size_t i = 1; i < maps_.size(); ++i) EXPECT_GE((maps_[i].at - maps_[i - 1].at).us, 500'000);
}

TEST_F(LiveMapperTest, MessagesOfOneTimeAreOneScan) {
  CloudScan near = wall(4.1);
  CloudScan far = wall(8.1);  // its rays pass the voxels of the other part
  run(0.3);
  for (int i = 0; i < 20; ++i) {
    near.at = far.at = runner_.now();
    runner_.observer().publish(channels::kPointCloud, near);
    runner_.observer().publish(channels::kPointCloud, far);
    run(0.1);
  }
  run(0.6);
  EXPECT_EQ(label_at({4.1, 5, 1}), VoxelLabel::Occupied);
  EXPECT_EQ(label_at({8.1, 5, 1}), VoxelLabel::Occupied);
}

TEST_F(LiveMapperTest, AMessageOfAnotherRangeIsAnotherScan) {
  CloudScan unlimited;
  unlimited.at = runner_.now();
  unlimited.sensor_position = Vec3(1, 5, 1);
  unlimited.points = {{Eigen::Vector3f(0, 4, 0), 0}};
  CloudScan limited = unlimited;
  limited.range_m = 2.0;
  limited.points = {{Eigen::Vector3f(8, 0, 0), 0}};
  runner_.observer().publish(channels::kPointCloud, unlimited);
  runner_.observer().publish(channels::kPointCloud, limited);
  run(1.2);
  EXPECT_EQ(label_at({1.1, 9.1, 1}), VoxelLabel::Occupied);
  EXPECT_EQ(label_at({2.6, 5, 1}), VoxelLabel::Free);
  EXPECT_EQ(label_at({6, 5, 1}), VoxelLabel::Unknown);
  EXPECT_EQ(label_at({9.1, 5, 1}), VoxelLabel::Unknown);
}

TEST_F(LiveMapperTest, ADepthImageBecomesOccupiedAndFreeVoxels) {
  DepthImage image;
  image.sensor_position = Vec3(1, 5, 1);
  image.q_WC = Eigen::Vector4d(0.5, -0.5, 0.5, -0.5);  // z to the world's x, x to −y, y to −z
  image.fx = image.fy = 40.0;
  image.width = 41;
  image.cx = 20.0;
  image.cy = 5.0;
  image.depths.assign(41 * 11, 5'100);
  image.depths[5 * 41 + 20] = 0;  // no measurement
  image.at = runner_.now();
  runner_.observer().publish(channels::kDepthImage, image);
  run(1.2);
  EXPECT_EQ(label_at({6.1, 5.5, 1}), VoxelLabel::Occupied);
  EXPECT_EQ(label_at({6.1, 3.0, 0.6}), VoxelLabel::Occupied);
  EXPECT_EQ(label_at({3, 5, 1}), VoxelLabel::Free);
  EXPECT_EQ(label_at({9, 5, 1}), VoxelLabel::Unknown);
}

TEST_F(LiveMapperTest, ADriverThatRepeatsAScanWhileTheVehicleMovesFreesNoWall) {
  for (int i = 0; i < 10; ++i) {
    runner_.observer().publish(channels::kPointCloud, wall(6.1));
    run(0.1);
  }
  ASSERT_EQ(label_at({6.1, 5, 1}), VoxelLabel::Occupied);
  for (int i = 0; i < 20; ++i) {
    CloudScan repeated = wall(6.1);
    repeated.sensor_position.x() += 0.5 + 0.05 * i;
    // The driver turns the same measurement by the attitude that it knows.
    for (CloudPoint& point : repeated.points) {
      point.position = Eigen::AngleAxisf(0.01F * static_cast<float>(i), Eigen::Vector3f::UnitZ()) * point.position;
    }
    runner_.observer().publish(channels::kPointCloud, repeated);
    run(0.1);
  }
  EXPECT_EQ(label_at({6.1, 5, 1}), VoxelLabel::Occupied);
  EXPECT_EQ(node_->health().state, ProcessState::Waiting);
  EXPECT_THAT(node_->health().waiting_for, HasSubstr("sensor 0 is frozen"));
}

TEST_F(LiveMapperTest, AScanThatIsOldWhenItComesIsNotUsedAndIsNamed) {
  run(3.0);
  for (int i = 0; i < 10; ++i) {
    CloudScan old = wall(6.1);
    old.at = old.at - Duration{2'000'000};
    runner_.observer().publish(channels::kPointCloud, old);
    run(0.1);
  }
  EXPECT_TRUE(maps_.empty());
  EXPECT_EQ(node_->health().state, ProcessState::Waiting);
  EXPECT_THAT(node_->health().waiting_for, HasSubstr("sensor 0: its POINT_CLOUD is 2 s old"));
}

TEST_F(LiveMapperTest, AFlightDoesNotBeginWithScansWithoutAMeasuredPoint) {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  CloudScan covered = wall(6.1);
  for (CloudPoint& point : covered.points) point.position.setConstant(kNaN);
  const auto send = [&] {
    covered.at = runner_.now();
    runner_.observer().publish(channels::kPointCloud, covered);
    run(0.1);
  };
  for (int i = 0; i < 10; ++i) send();
  EXPECT_TRUE(maps_.empty());
  EXPECT_EQ(node_->health().state, ProcessState::Waiting);
  EXPECT_THAT(node_->health().waiting_for, HasSubstr("sensor 0: scans without a measured point"));
  for (CloudPoint& point : covered.points) point.position = Eigen::Vector3f(0.1F, 0, 0);  // the lens cap
  for (int i = 0; i < 10; ++i) send();
  EXPECT_TRUE(maps_.empty());
  runner_.observer().publish(channels::kPointCloud, wall(6.1));
  run(0.1);
  EXPECT_EQ(node_->health().state, ProcessState::Ready);
  for (int i = 0; i < 25; ++i) send();
  EXPECT_EQ(node_->health().state, ProcessState::Waiting) << "covered in flight";
  EXPECT_THAT(node_->health().waiting_for, HasSubstr("scans: the last usable one came"));
}

TEST_F(LiveMapperTest, AnEmptyFieldIsAMeasurementFromWhereverItIsSeen) {
  CloudScan empty = wall(6.1);
  empty.range_m = 4.0;
  for (CloudPoint& point : empty.points) point.position *= 100.0F / point.position.norm();
  for (int i = 0; i < 30; ++i) {
    empty.at = runner_.now();
    empty.sensor_position.x() += 0.1;
    runner_.observer().publish(channels::kPointCloud, empty);
    run(0.1);
  }
  EXPECT_EQ(node_->health().state, ProcessState::Ready);
  EXPECT_EQ(node_->health().waiting_for, "");
  EXPECT_EQ(label_at({7.1, 5, 1}), VoxelLabel::Free);
}

/// The parts of an OctoMap of 16³ voxels of 0.5 m whose lower corner is at `origin`: free, but for one voxel.
std::vector<MapFile> octomap_at(UTime at, const Vec3& origin, const Eigen::Vector3i& occupied, std::size_t part_bytes) {
  constexpr int kSide = 16;
  std::vector<VoxelLabel> labels(kSide * kSide * kSide, VoxelLabel::Free);
  labels[static_cast<std::size_t>(occupied.x() + kSide * (occupied.y() + kSide * occupied.z()))] = VoxelLabel::Occupied;
  const support::FileBytes file = support::octomap_file(labels, kSide, true);
  std::vector<MapFile> parts;
  for (std::size_t k = 0; k < file.size(); k += part_bytes) {
    MapFile part;
    part.at = at;
    part.origin = origin;
    part.part = static_cast<std::int32_t>(parts.size());
    part.parts = static_cast<std::int32_t>((file.size() + part_bytes - 1) / part_bytes);
    const auto begin = file.begin() + static_cast<std::ptrdiff_t>(k);
    part.bytes.assign(begin, begin + static_cast<std::ptrdiff_t>(std::min(part_bytes, file.size() - k)));
    parts.push_back(part);
  }
  return parts;
}

TEST_F(LiveMapperTest, AnOctoMapInPartsBecomesTheMapAndTheNextOneTakesItsPlace) {
  run(0.1);
  auto parts = octomap_at(runner_.now(), Vec3(1, 1, 0), {8, 8, 2}, 50);
  ASSERT_GT(parts.size(), 2u);
  std::swap(parts[0], parts[1]);
  for (const MapFile& part : parts) runner_.observer().publish(channels::kMapFile, part);
  run(1.2);
  EXPECT_EQ(node_->health().state, ProcessState::Ready);
  EXPECT_EQ(label_at({5.1, 5.1, 1.1}), VoxelLabel::Occupied);
  EXPECT_EQ(label_at({4.9, 5.1, 1.1}), VoxelLabel::Free);
  EXPECT_EQ(label_at({9.5, 5.1, 1.1}), VoxelLabel::Unknown);
  const std::size_t versions = maps_.size();
  for (const MapFile& part : parts) runner_.observer().publish(channels::kMapFile, part);
  run(2.6);
  EXPECT_EQ(maps_.size(), versions) << "the same file again";
  EXPECT_EQ(node_->health().waiting_for, "") << "an OctoMap stays valid";
  for (const MapFile& part : octomap_at(runner_.now(), Vec3(1, 1, 0), {2, 2, 2}, 50))
    runner_.observer().publish(channels::kMapFile, part);
  run(1.2);
  EXPECT_EQ(label_at({5.1, 5.1, 1.1}), VoxelLabel::Free);
  EXPECT_EQ(label_at({2.1, 2.1, 1.1}), VoxelLabel::Occupied);
}

TEST_F(LiveMapperTest, ABrokenOctoMapChangesNothingAndIsReported) {
  for (const MapFile& part : octomap_at(runner_.now(), Vec3(1, 1, 0), {8, 8, 2}, 1'000))
    runner_.observer().publish(channels::kMapFile, part);
  run(1.2);
  auto broken = octomap_at(runner_.now(), Vec3(1, 1, 0), {2, 2, 2}, 1'000);
  broken.back().bytes.resize(broken.back().bytes.size() - 3);
  for (const MapFile& part : broken) runner_.observer().publish(channels::kMapFile, part);
  run(1.2);
  EXPECT_EQ(label_at({5.1, 5.1, 1.1}), VoxelLabel::Occupied);
  EXPECT_EQ(node_->health().state, ProcessState::Ready);
  EXPECT_THAT(node_->health().waiting_for, HasSubstr("an OctoMap is not used: MAP_FILE, offset "));
}

TEST_F(LiveMapperTest, AnOctoMapWithIllegibleBytesInItsHeadIsReportedInAHeartbeatThatReceiversAccept) {
  std::optional<Heartbeat> newest;
  runner_.observer().subscribe(channels::kHeartbeat, [&](const Heartbeat& heartbeat) { newest = heartbeat; });
  const std::string head = "# Octomap OcTree file\nid \xff\x01\nsize 1\nres 0.1\ndata\n";
  MapFile file;
  file.at = runner_.now();
  file.part = 0;
  file.parts = 1;
  file.bytes.assign(head.begin(), head.end());
  runner_.observer().publish(channels::kMapFile, file);
  run(0.1);
  newest.reset();
  run(1.2);
  ASSERT_TRUE(newest) << "the mapper would count as silent";
  EXPECT_EQ(newest->process, "tern-mapper");
  EXPECT_THAT(newest->waiting_for, HasSubstr("a tree of the kind ??: OcTree and ColorOcTree are read"));
}

TEST_F(LiveMapperTest, ARestartedMapperPublishesNoMapWithoutTheWallsOfAnOctoMap) {
  run(4.0);
  EXPECT_TRUE(maps_.empty());
  for (const MapFile& part : octomap_at(runner_.now(), Vec3(1, 1, 0), {8, 8, 2}, 1'000))
    runner_.observer().publish(channels::kMapFile, part);
  run(0.1);
  ASSERT_EQ(maps_.size(), 1u);
  EXPECT_EQ(label_at({5.1, 5.1, 1.1}), VoxelLabel::Occupied);
}

TEST_F(LiveMapperTest, AnOctoMapBesideTheMapIsRefusedAndChangesNothing) {
  const auto send = [&](const Vec3& origin) {
    for (const MapFile& part : octomap_at(runner_.now(), origin, {8, 8, 2}, 1'000))
      runner_.observer().publish(channels::kMapFile, part);
    run(1.2);
  };
  send(Vec3(500, 0, 0));
  EXPECT_EQ(node_->health().state, ProcessState::Waiting);
  EXPECT_THAT(node_->health().waiting_for, HasSubstr("an OctoMap is not used: none of its"));
  send(Vec3(1, 1, 0));
  EXPECT_EQ(node_->health().state, ProcessState::Ready);
  send(Vec3(500, 0, 0));
  EXPECT_EQ(label_at({5.1, 5.1, 1.1}), VoxelLabel::Occupied);
  EXPECT_THAT(node_->health().waiting_for, HasSubstr("an OctoMap is not used: none of its"));
}

TEST(LiveIntake, PlacesPixelsByThePinholeModel) {
  DepthImage image;
  image.sensor_position = Vec3(10, 20, 30);
  image.q_WC = Eigen::Vector4d(0.5, -0.5, 0.5, -0.5);
  image.fx = 100.0;
  image.fy = 200.0;
  image.cx = 1.0;
  image.cy = 7.0;
  image.width = 2;
  image.first_row = 7;
  image.depths = {0, 2'000, 1'000, -5};
  const Scan scan = scan_of(image);
  ASSERT_EQ(scan.points.size(), 2u);
  EXPECT_LT((scan.points[0].position - Vec3(12, 20, 30)).norm(), 1e-12) << "on the optical axis, along x";
  EXPECT_LT((scan.points[1].position - Vec3(11, 20.01, 29.995)).norm(), 1e-12) << "left of it and below";
}

/// Collects scans, and never adds them by itself.
struct Collector : Node {
  explicit Collector(Bus& bus) : intake(bus) {}
  [[nodiscard]] UTime next_wakeup() const override { return kNever; }
  void step(UTime) override {}
  [[nodiscard]] NodeHealth health() const override { return {}; }
  LiveIntake intake;
};

TEST(LiveIntake, OfAFloodTheNewestScanIsAddedAndTheOthersAreCounted) {
  VirtualRunner runner;
  auto& collector =
      dynamic_cast<Collector&>(runner.start("tern-mapper", [](Bus& bus) { return std::make_unique<Collector>(bus); }));
  CloudScan part;
  part.sensor_position = Vec3(1, 5, 1);
  part.points.assign(kMaxCloudPointsPerMessage, {});
  for (const float x : {2.0F, 4.0F, 6.0F}) {
    part.at = runner.now();
    for (CloudPoint& point : part.points) point.position = Eigen::Vector3f(x, 0, 0);
    for (std::size_t sent = 0; sent < kMaxScanPoints; sent += part.points.size()) {
      runner.observer().publish(channels::kPointCloud, part);
    }
    runner.run(runner.now() + Duration{1'000});
  }
  VoxelMap base = support::free_map({40, 40, 8});
  std::fill(base.labels.begin(), base.labels.end(), VoxelLabel::Unknown);
  LiveMap map(base, {}, {});
  EXPECT_EQ(collector.intake.add_to(map, runner.now() + kScanParts), 1);
  EXPECT_EQ(collector.intake.left_out(), 2);
  const VoxelMap now = map.map({}, Vec3(1e3, 0, 0));
  const auto label_at = [&](double x) { return now.labels[idx(now.grid.index(now.grid.cell_of({x, 5, 1})))]; };
  EXPECT_EQ(label_at(7.1), VoxelLabel::Occupied);
  EXPECT_EQ(label_at(3.1), VoxelLabel::Free);
}

TEST(LiveIntake, PointsThatAreNotFiniteGiveNone) {
  CloudScan cloud;
  cloud.sensor_position = Vec3(1, 2, 3);
  cloud.points = {{Eigen::Vector3f(1, 0, 0), 6}, {Eigen::Vector3f(std::nanf(""), 0, 0), 0}};
  const Scan scan = scan_of(cloud);
  ASSERT_EQ(scan.points.size(), 1u);
  EXPECT_EQ(scan.points[0].position, Vec3(2, 2, 3));
  EXPECT_EQ(scan.points[0].class_number, 6);
}

}  // namespace
}  // namespace tern
