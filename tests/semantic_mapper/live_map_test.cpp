#include "semantic_mapper/voxel_map/live_map.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <set>

#include "core/base/random.h"
#include "core/wire/message_limits.h"
#include "semantic_mapper/sources/octomap.h"
#include "semantic_mapper/voxel_map/ray_walk.h"
#include "semantic_mapper/voxel_map/voxel_painter.h"
#include "tests/support/effort.h"
#include "tests/support/voxel_maps.h"

namespace tern {
namespace {

const ScanRange kRange{0.3, 20.0};

VoxelMap unknown_map(const Eigen::Vector3i& size, double resolution = 0.5, const Vec3& origin = Vec3::Zero()) {
  VoxelMap map = support::free_map(size, resolution, origin);
  std::fill(map.labels.begin(), map.labels.end(), VoxelLabel::Unknown);
  return map;
}

Body ball() {
  Body body;
  body.vertices = Points::Zero(3, 1);
  body.radius = 0.2;
  return body;
}

VoxelMap now(const LiveMap& map) { return map.map(ball(), Vec3(1e3, 0, 0)); }
VoxelLabel label_at(const LiveMap& map, const Vec3& p) {
  const VoxelMap labels = now(map);
  return labels.labels[idx(labels.grid.index(labels.grid.cell_of(p)))];
}

Scan scan_to(std::vector<Vec3> points, const Vec3& sensor) {
  Scan scan;
  scan.sensor = sensor;
  for (const Vec3& p : points) scan.points.push_back({p, 0});
  return scan;
}

/// A row of 10 voxels along x, with a sensor in the first one.
const Vec3 kSensor(0.25, 0.25, 0.25);
Vec3 in_voxel(int i) { return {0.5 * i + 0.3, 0.25, 0.25}; }

TEST(RayWalk, PassesExactlyTheVoxelsOfTheSegment) {
  const VoxelGrid grid{Vec3(-1, 2, 0.5), 0.4, {9, 7, 5}};
  Rng rng(1);
  for (int n = 0; n < support::at_effort(3'000); ++n) {
    const auto point = [&] { return Vec3(rng.uniform(-3, 5), rng.uniform(0, 7), rng.uniform(-1, 4)); };
    const Vec3 a = point();
    Vec3 b = point();
    if (n % 5 == 0) b.y() = a.y();
    if (n % 7 == 0) b.z() = a.z();
    std::vector<std::int64_t> walked;
    walk_ray(grid, a, b, [&](std::int64_t voxel) { walked.push_back(voxel); });
    const std::set<std::int64_t> set(walked.begin(), walked.end());
    EXPECT_EQ(set.size(), walked.size()) << "no voxel twice";
    for (int i = 0; i <= 2000; ++i) {
      const Vec3 p = a + (b - a) * (i / 2000.0);
      const Eigen::Vector3i cell = grid.cell_of(p);
      if (!grid.contains(cell)) continue;
      // Rounding may put a point on a face into either voxel.
      const Vec3 inside = (p - grid.corner(cell)) / grid.resolution;
      if (inside.minCoeff() < 1e-9 || inside.maxCoeff() > 1.0 - 1e-9) continue;
      EXPECT_TRUE(set.count(grid.index(cell))) << n << " " << i;
    }
    const double length = (b - a).norm();
    for (const std::int64_t voxel : walked) {
      const Box box = grid.box(grid.cell(voxel));
      double nearest = 1e9;
      for (int i = 0; i <= 2000; ++i) nearest = std::min(nearest, box.exteriorDistance(a + (b - a) * (i / 2000.0)));
      EXPECT_LE(nearest, length / 4000.0 + 1e-9);
    }
    for (std::size_t i = 1; i < walked.size(); ++i) {
      EXPECT_EQ((grid.cell(walked[i]) - grid.cell(walked[i - 1])).cwiseAbs().sum(), 1) << "neighbours share a face";
    }
  }
}

TEST(LiveMap, ARayFreesTheSpaceBeforeThePointAndLeavesTheRestUnknown) {
  LiveMap map(unknown_map({10, 1, 1}), {}, kRange);
  map.add(scan_to({in_voxel(6)}, kSensor));
  for (int i = 0; i < 6; ++i) EXPECT_EQ(label_at(map, in_voxel(i)), VoxelLabel::Free) << i;
  EXPECT_EQ(label_at(map, in_voxel(6)), VoxelLabel::Occupied);
  for (int i = 7; i < 10; ++i) EXPECT_EQ(label_at(map, in_voxel(i)), VoxelLabel::Unknown) << i;
  const VoxelMap labels = now(map);
  EXPECT_EQ(labels.class_names[labels.classes[6]], "unlabelled");
  EXPECT_EQ(labels.classes[2], 0);
}

TEST(LiveMap, ObstaclesThatLeaveAreCarvedAwayByNineScansAtMost) {
  LiveMap map(unknown_map({10, 1, 1}), {}, kRange);
  for (int i = 0; i < 1000; ++i) map.add(scan_to({in_voxel(4)}, kSensor));
  int scans = 0;
  while (label_at(map, in_voxel(4)) == VoxelLabel::Occupied && scans < 100) {
    map.add(scan_to({in_voxel(8)}, kSensor));
    ++scans;
  }
  EXPECT_EQ(scans, 9);
  map.add(scan_to({in_voxel(4)}, kSensor));
  map.add(scan_to({in_voxel(4)}, kSensor));
  EXPECT_EQ(label_at(map, in_voxel(4)), VoxelLabel::Occupied) << "and they come back";
}

TEST(LiveMap, AVoxelWithAPointIsNotFreedByOtherRaysOfTheScan) {
  LiveMap map(unknown_map({10, 1, 1}), {}, kRange);
  std::vector<Vec3> points{in_voxel(4)};
  points.insert(points.end(), 50, in_voxel(8));
  map.add(scan_to(points, kSensor));
  EXPECT_EQ(label_at(map, in_voxel(4)), VoxelLabel::Occupied);
  EXPECT_EQ(label_at(map, in_voxel(8)), VoxelLabel::Occupied);
}

TEST(LiveMap, NeverFreesWhatAFileOrRegionSaysIsOccupied) {
  VoxelMap base = unknown_map({10, 1, 1});
  support::paint(base, {4, 0, 0}, {4, 0, 0}, VoxelLabel::Occupied);
  support::paint(base, {5, 0, 0}, {5, 0, 0}, VoxelLabel::Repulsive);
  LiveMap map(base, {}, kRange);
  for (int i = 0; i < 50; ++i) map.add(scan_to({in_voxel(8)}, kSensor));
  EXPECT_EQ(label_at(map, in_voxel(4)), VoxelLabel::Occupied);
  EXPECT_EQ(label_at(map, in_voxel(5)), VoxelLabel::Repulsive);
  EXPECT_EQ(label_at(map, in_voxel(6)), VoxelLabel::Free);
  map.add(scan_to({in_voxel(5)}, kSensor));
  for (int i = 0; i < 20; ++i) map.add(scan_to({in_voxel(5)}, kSensor));
  EXPECT_EQ(label_at(map, in_voxel(5)), VoxelLabel::Occupied) << "a point there is stronger";
}

/// An OctoMap of voxels of 0.5 m in a row along x.
OctoMapFile row_of(const std::vector<VoxelLabel>& labels) {
  OctoMapFile octomap;
  octomap.resolution = 0.5;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] == VoxelLabel::Unknown) continue;
    octomap.leaves.push_back({{static_cast<std::int32_t>(i), 0, 0}, 1, labels[i] == VoxelLabel::Occupied});
  }
  return octomap;
}

TEST(LiveMap, TheNewestOctoMapCountsUnlessAFileOrAScanSaysMore) {
  using enum VoxelLabel;
  VoxelMap base = unknown_map({10, 1, 1});
  base.labels[1] = Occupied;
  LiveMap map(base, {}, kRange);
  EXPECT_TRUE(map.set_octomap(row_of({Free, Free, Occupied, Unknown, Occupied})));
  const auto labels = [&] {
    const VoxelMap all = now(map);
    return std::vector<VoxelLabel>(all.labels.begin(), all.labels.begin() + 5);
  };
  EXPECT_EQ(labels(), (std::vector{Free, Occupied, Occupied, Unknown, Occupied}));
  EXPECT_EQ(now(map).class_names.at(now(map).classes[2]), kUnlabelled);
  map.add(scan_to({in_voxel(8)}, kSensor));
  EXPECT_EQ(labels(), (std::vector{Free, Occupied, Occupied, Free, Occupied})) << "a scan frees none of its voxels";
  EXPECT_TRUE(map.set_octomap(row_of({Free, Free, Free, Free, Free, Free, Free, Free, Free})));
  EXPECT_EQ(labels(), (std::vector{Free, Occupied, Free, Free, Free}));
  EXPECT_EQ(label_at(map, in_voxel(8)), Occupied) << "nor does an OctoMap free those of scans";
}

TEST(LiveMap, PointsOfAClassGetItsLabelAndThoseWithoutAMeaningMarkNothing) {
  ClassMeanings classes;
  classes[5] = ClassMeaning{"high_vegetation", VoxelLabel::Attractive};
  classes[6] = ClassMeaning{"building", VoxelLabel::Occupied};
  LiveMap map(unknown_map({10, 1, 1}), classes, kRange);
  Scan scan = scan_to({in_voxel(3), in_voxel(5), in_voxel(5), in_voxel(7)}, kSensor);
  scan.has_classes = true;
  scan.points[0].class_number = 5;
  scan.points[1].class_number = 5;
  scan.points[2].class_number = 6;
  scan.points[3].class_number = 40;
  map.add(scan);
  EXPECT_EQ(label_at(map, in_voxel(3)), VoxelLabel::Attractive);
  EXPECT_EQ(label_at(map, in_voxel(5)), VoxelLabel::Occupied) << "the stronger class of two";
  EXPECT_EQ(label_at(map, in_voxel(6)), VoxelLabel::Free);
  EXPECT_EQ(label_at(map, in_voxel(7)), VoxelLabel::Unknown);
  const VoxelMap labels = now(map);
  EXPECT_EQ(labels.class_names[labels.classes[5]], "building");
}

TEST(LiveMap, PointsBeyondTheRangeAreFreeSpaceUpToItAndNearOnesAreIgnored) {
  LiveMap map(unknown_map({10, 1, 1}), {}, {0.3, 2.0});
  map.add(scan_to({Vec3(100, 0.25, 0.25), Vec3(0.5, 0.25, 0.25)}, kSensor));
  EXPECT_EQ(label_at(map, in_voxel(0)), VoxelLabel::Free);
  EXPECT_EQ(label_at(map, in_voxel(4)), VoxelLabel::Free) << "2.25 m is the end of the range";
  EXPECT_EQ(label_at(map, in_voxel(5)), VoxelLabel::Unknown);
  Scan scan = scan_to({Vec3(100, 0.25, 0.25)}, Vec3(2.6, 0.25, 0.25));
  scan.range = 1.0;
  map.add(scan);
  EXPECT_EQ(label_at(map, in_voxel(7)), VoxelLabel::Free);
  EXPECT_EQ(label_at(map, in_voxel(8)), VoxelLabel::Unknown);
  map.add(scan_to({Vec3(1e38, 1e38, -1e38), Vec3(-1e300, 0, 0), kSensor}, kSensor));
  map.add(scan_to({in_voxel(2)}, Vec3(-1e6, 0.25, 0.25)));
}

TEST(LiveMap, TheVehicleDoesNotStandInItsMap) {
  LiveMap map(unknown_map({10, 1, 4}), {}, kRange);
  std::vector<Vec3> ground;
  for (int i = 0; i < 10; ++i) ground.push_back(in_voxel(i));
  map.add(scan_to(ground, Vec3(2.3, 0.25, 1.7)));
  EXPECT_EQ(label_at(map, in_voxel(4)), VoxelLabel::Occupied);
  const VoxelMap stands = map.map(ball(), Vec3(2.25, 0.25, 0.6));
  EXPECT_EQ(stands.labels[4], VoxelLabel::Free);
  EXPECT_EQ(stands.labels[1], VoxelLabel::Occupied);
  EXPECT_EQ(stands.version, stands.compute_version());
}

TEST(LiveMap, InFlightTheVehicleFreesOfAWallOnlyWhatItOverlaps) {
  LiveMap map(unknown_map({20, 3, 4}), {}, kRange);
  std::vector<Vec3> wall;
  for (int i = 0; i < 12; ++i) wall.emplace_back(7.25, 0.25 + 0.5 * (i % 3), 0.25 + 0.5 * (i / 3));
  map.add(scan_to(wall, Vec3(1.25, 0.75, 0.9)));
  const Vec3 beside(6.85, 0.75, 1.0);  // reaches 0.05 m into the wall
  const auto occupied_at = [&](const Vec3& p) {
    const VoxelMap labels = map.map(ball(), beside);
    return labels.labels[idx(labels.grid.index(labels.grid.cell_of(p)))] == VoxelLabel::Occupied;
  };
  map.free_start(ball(), Vec3(1.25, 0.75, 0.9));
  EXPECT_FALSE(occupied_at({7.25, 0.75, 1.25}));
  EXPECT_TRUE(occupied_at({7.25, 0.25, 1.25}));
  EXPECT_TRUE(occupied_at({7.25, 0.75, 1.75}));
  map.free_start(ball(), beside);
  EXPECT_FALSE(occupied_at({7.25, 0.25, 1.25})) << "at the start it needs room for a tube";
}

TEST(LiveMap, OnTheGroundThatItLandsOnTheVehicleHasRoomForATube) {
  LiveMap map(unknown_map({20, 3, 4}), {}, kRange);
  std::vector<Vec3> ground;
  for (int i = 0; i < 60; ++i) ground.emplace_back(0.25 + 0.5 * (i % 20), 0.25 + 0.5 * (i / 20), 0.25);
  map.add(scan_to(ground, Vec3(1.25, 0.75, 1.9)));
  map.free_start(ball(), Vec3(1.25, 0.75, 0.6));
  const VoxelMap landed = map.map(ball(), Vec3(6.75, 0.75, 0.65));
  for (const double y : {0.25, 0.75, 1.25}) {
    EXPECT_EQ(landed.labels[idx(landed.grid.index(landed.grid.cell_of({6.75, y, 0.25})))], VoxelLabel::Free);
  }
}

TEST(LiveMap, AVehicleThatIsSaidToBeInAWallOfAFileDoesNotFreeIt) {
  VoxelMap walls = unknown_map({10, 1, 4});
  walls.labels[4] = VoxelLabel::Occupied;
  const LiveMap map(walls, {}, kRange);
  EXPECT_EQ(map.map(ball(), Vec3(2.25, 0.25, 0.6)).labels[4], VoxelLabel::Occupied);
}

TEST(LiveMap, UnseenSpaceAroundTheStartIsFree) {
  LiveMap map(unknown_map({10, 10, 10}), {}, kRange);
  map.add(scan_to({Vec3(2.25, 2.25, 1.25)}, Vec3(2.25, 2.25, 4.75)));
  map.free_start(ball(), Vec3(2.25, 2.25, 2.25));
  EXPECT_EQ(label_at(map, Vec3(2.25, 2.25, 1.25)), VoxelLabel::Occupied) << "seen";
  EXPECT_EQ(label_at(map, Vec3(3.25, 2.25, 2.25)), VoxelLabel::Free);
  EXPECT_EQ(label_at(map, Vec3(3.75, 2.25, 2.25)), VoxelLabel::Unknown);
  map.free_start(ball(), Vec3(0, 0, 1e4));
}

TEST(LiveMap, MakesOfAScanTheMapThatOctoMapMakes) {
  // The scan of golden/make_octomaps.cpp, with its numbers as float32.
  Scan walls;
  walls.sensor = Eigen::Vector3f(0.05F, 0.05F, 1.05F).cast<double>();
  const auto add = [&](double x, double y, double z) {
    walls.points.push_back({Eigen::Vector3d(x, y, z).cast<float>().cast<double>(), 0});
  };
  for (double z = 0; z < 2; z += 0.1) {
    for (double x = -2; x < 2; x += 0.1) {
      add(x, -1.45, z);
      add(x, 1.45, z);
    }
    for (double y = -1.5; y < 1.5; y += 0.1) {
      add(-1.95, y, z);
      add(1.95, y, z);
    }
  }
  LiveMap map(unknown_map({22, 18, 13}, 0.2, Vec3(-2.2, -1.8, -0.4)), {}, kRange);
  for (int i = 0; i < 5; ++i) map.add(walls);
  const VoxelMap live = now(map);

  std::ifstream stream(TERN_MAP_GOLDEN "/room.ot", std::ios::binary);
  const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(stream), {}};
  MapSources sources;
  sources.octomaps.push_back(parse_octomap(bytes, "room.ot", {}).value());
  MapBuildOptions options;
  options.extents = live.grid.bounds();
  options.resolution = 0.2;
  options.background = VoxelLabel::Unknown;
  const VoxelMap octomap = build_map(sources, options)->map;
  ASSERT_EQ(octomap.grid.size, live.grid.size);
  int different = 0;
  for (std::size_t i = 0; i < live.labels.size(); ++i) {
    const bool is_wall = octomap.labels[i] == VoxelLabel::Occupied;
    EXPECT_EQ(live.labels[i] == VoxelLabel::Occupied, is_wall) << i;
    different += live.labels[i] != octomap.labels[i] ? 1 : 0;
  }
  // OctoMap walks in float32: rays through edges of voxels may pass another neighbour.
  EXPECT_LE(different, 10);
}

TEST(LiveMap, RefusesAMapThatIsTooLarge) {
  EXPECT_THROW(LiveMap(unknown_map({1000, 1000, 21}), {}, kRange), std::invalid_argument);
}

TEST(LiveMap, RefusesMoreClassesThanAMapCanName) {
  ClassMeanings classes;
  for (std::size_t i = 0; i < 254; ++i) classes[i] = ClassMeaning{"class_" + std::to_string(i), VoxelLabel::Occupied};
  const LiveMap full(unknown_map({1, 1, 1}), classes, kRange);
  EXPECT_EQ(std::ssize(now(full).class_names), kMaxMapClasses);
  classes[254] = ClassMeaning{"class_254", VoxelLabel::Occupied};
  EXPECT_THROW(LiveMap(unknown_map({1, 1, 1}), classes, kRange), std::length_error);
}

}  // namespace
}  // namespace tern
