#include "semantic_mapper/voxel_map/map_builder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "core/geometry/box.h"

namespace tern {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Region region(const char* class_name, const std::variant<Box, BallRegion, PrismRegion>& shape) {
  return {class_name, class_name, shape};
}

MapSources sources_of(std::vector<Region> regions) {
  MapSources sources;
  sources.regions = std::move(regions);
  sources.region_classes = {{"wall", VoxelLabel::Occupied},
                            {"water", VoxelLabel::Repulsive},
                            {"texture", VoxelLabel::Attractive},
                            {"air", VoxelLabel::Free},
                            {"fog", VoxelLabel::Unknown}};
  return sources;
}

VoxelMap build(const MapSources& sources, const MapBuildOptions& options = {}) {
  auto map = build_map(sources, options);
  EXPECT_TRUE(map) << map.error().message;
  return map ? map->map : VoxelMap{};
}

VoxelLabel label_at(const VoxelMap& map, const Vec3& p) {
  const Eigen::Vector3i cell = map.grid.cell_of(p);
  EXPECT_TRUE(map.grid.contains(cell)) << p.transpose();
  return map.grid.contains(cell) ? map.labels[static_cast<std::size_t>(map.grid.index(cell))] : VoxelLabel::Unknown;
}

std::int64_t count(const VoxelMap& map, VoxelLabel label) {
  return std::count(map.labels.begin(), map.labels.end(), label);
}

TEST(MapBuilder, AlignedBoxesAreExact) {
  const VoxelMap map = build(sources_of({region("texture", Box(Vec3(15, 1, 0), Vec3(30, 3, 4)))}));
  EXPECT_EQ(map.grid.origin, Vec3(15, 1, 0));
  EXPECT_EQ(map.grid.size, Eigen::Vector3i(60, 8, 16));
  EXPECT_EQ(count(map, VoxelLabel::Attractive), 60 * 8 * 16);
  EXPECT_THAT(map.class_names, ElementsAre("", "texture"));
  EXPECT_EQ(map.version, map.compute_version());
}

TEST(MapBuilder, OccupiedShapesLoseNothingAndOthersFollowVoxelCentres) {
  MapBuildOptions options;
  options.extents = Box(Vec3(-2, -2, -2), Vec3(2, 2, 2));
  const std::vector<std::variant<Box, BallRegion, PrismRegion>> shapes{
      Box(Vec3(-0.6, 0.1, -0.3), Vec3(0.7, 0.9, 1.1)), BallRegion{Vec3(0.1, 0.2, -0.3), 1.17},
      PrismRegion{{{-1.1, -0.9}, {1.3, -0.4}, {0.2, 1.6}}, -0.6, 0.9}};
  for (const auto& shape : shapes) {
    const Region solid = region("wall", shape);
    const Region soft = region("water", shape);
    const VoxelMap walls = build(sources_of({solid}), options);
    const VoxelMap water = build(sources_of({soft}), options);
    for (std::int64_t i = 0; i < walls.grid.voxels(); ++i) {
      const Box voxel = walls.grid.box(walls.grid.cell(i));
      const auto v = static_cast<std::size_t>(i);
      EXPECT_EQ(water.labels[v] == VoxelLabel::Repulsive, soft.contains(voxel.center()));
      // Every part of the solid lies in an occupied voxel, and occupied voxels are within a voxel's diagonal of it.
      for (int k = 0; k < 27; ++k) {
        const Vec3 u = Vec3(k % 3, k / 3 % 3, k / 9) * 0.4995 + Vec3::Constant(0.0005);
        if (solid.contains(voxel.min() + u * 0.25)) {
          EXPECT_EQ(walls.labels[v], VoxelLabel::Occupied);
        }
      }
      if (walls.labels[v] == VoxelLabel::Occupied) {
        EXPECT_LE(solid.distance(voxel.center()), 0.25 * 0.87);
      }
    }
  }
}

TEST(MapBuilder, TheStrongerLabelStays) {
  const auto box = [](double x0, double x1) { return Box(Vec3(x0, 0, 0), Vec3(x1, 1, 1)); };
  std::vector<Region> regions{region("wall", box(0, 1)), region("water", box(0, 2)), region("texture", box(0, 3)),
                              region("air", box(0, 4)), region("fog", box(0, 5))};
  for (int turn = 0; turn < 5; ++turn) {
    MapBuildOptions options;
    options.extents = box(0, 6);
    options.background = VoxelLabel::Free;
    const VoxelMap map = build(sources_of(regions), options);
    EXPECT_EQ(label_at(map, Vec3(0.5, 0.5, 0.5)), VoxelLabel::Occupied);
    EXPECT_EQ(label_at(map, Vec3(1.5, 0.5, 0.5)), VoxelLabel::Repulsive);
    EXPECT_EQ(label_at(map, Vec3(2.5, 0.5, 0.5)), VoxelLabel::Attractive);
    EXPECT_EQ(label_at(map, Vec3(3.5, 0.5, 0.5)), VoxelLabel::Free);
    EXPECT_EQ(label_at(map, Vec3(4.5, 0.5, 0.5)), VoxelLabel::Unknown) << "a region speaks louder than the background";
    EXPECT_EQ(label_at(map, Vec3(5.5, 0.5, 0.5)), VoxelLabel::Free);
    std::rotate(regions.begin(), regions.begin() + 1, regions.end());
  }
}

TEST(MapBuilder, ObstaclesAreOccupied) {
  MapSources sources = sources_of({});
  sources.obstacles = {Box(Vec3(0.1, 0.1, 0.1), Vec3(0.6, 0.2, 0.2))};
  const VoxelMap map = build(sources);
  EXPECT_EQ(map.grid.size, Eigen::Vector3i(3, 1, 1));
  EXPECT_EQ(count(map, VoxelLabel::Occupied), 3);
  EXPECT_THAT(map.class_names, ElementsAre("", "obstacle"));
}

TEST(MapBuilder, ChoosesExtentsThatHoldEverythingAndStayHandy) {
  MapBuildOptions options;
  options.somewhere = Vec3(7.1, 0, 1);
  EXPECT_EQ(build(sources_of({}), options).grid.size, Eigen::Vector3i(1, 1, 1)) << "nothing to map";
  options.include = Box(Vec3(0, -3, 0), Vec3(75, 3, 4));
  EXPECT_EQ(build(sources_of({}), options).grid.size, Eigen::Vector3i(300, 24, 16));
  options.include = Box(Vec3::Constant(-1e4), Vec3::Constant(1e4));
  const Box water(Vec3(0.1, 0.1, 0.1), Vec3(0.9, 0.9, 0.9));
  EXPECT_EQ(build(sources_of({region("water", water)}), options).grid.size, Eigen::Vector3i(4, 4, 4))
      << "an open world";
}

TEST(MapBuilder, RefusesAMapThatIsTooLarge) {
  MapBuildOptions options;
  options.extents = Box(Vec3::Constant(-1e5), Vec3::Constant(1e5));
  const auto map = build_map(sources_of({}), options);
  ASSERT_FALSE(map);
  EXPECT_THAT(map.error().message, HasSubstr("limit 200000000"));
}

TEST(MapBuilder, AStrayPointFarAwayDoesNotRefuseTheRest) {
  MapSources sources = sources_of({region("wall", Box(Vec3(4, -2, 0), Vec3(4.5, 2, 2)))});
  sources.regions.push_back(region("wall", Box(Vec3(8e4, 8e4, 8e4), Vec3(8e4 + 1, 8e4 + 1, 8e4 + 1))));
  MapBuildOptions options;
  EXPECT_FALSE(build_map(sources, options)) << "without a flight box";
  options.include = Box(Vec3(-2, -6, 0), Vec3(24, 6, 4));
  const auto built = build_map(sources, options);
  ASSERT_TRUE(built) << built.error().message;
  EXPECT_THAT(built->cut, HasSubstr("the map is cut to uav.flight_box"));
  EXPECT_EQ(label_at(built->map, Vec3(4.1, 0.1, 0.1)), VoxelLabel::Occupied);
}

/// The ground of a scan: its voxels reach from -0.25 to 0.25 m.
MapSources ground() { return sources_of({region("wall", Box(Vec3(-3, -3, -0.1), Vec3(3, 3, 0.1)))}); }

MapBuildOptions standing_at(const Vec3& p, double radius = 0.3) {
  MapBuildOptions options;
  options.extents = Box(Vec3(-3, -3, -1), Vec3(3, 3, 3));
  options.body = Body{};
  options.body->radius = radius;
  options.somewhere = p;
  return options;
}

TEST(MapBuilder, FreesTheVoxelsInWhichTheVehicleStands) {
  // Of a ball that reaches 0.23 m into the ground's voxels, and of one that is smaller than a voxel.
  for (const auto& [z, radius] : {std::pair(0.32, 0.3), std::pair(0.3, 0.3), std::pair(0.05, 0.05)}) {
    const auto built = build_map(ground(), standing_at(Vec3(0.1, 0.1, z), radius));
    ASSERT_TRUE(built);
    EXPECT_GT(built->stood_in, 0) << z;
    EXPECT_EQ(label_at(built->map, Vec3(0.1, 0.1, 0.1)), VoxelLabel::Free) << z;
    EXPECT_EQ(label_at(built->map, Vec3(0.1, 0.1, -0.1)), VoxelLabel::Occupied) << z;
    EXPECT_EQ(label_at(built->map, Vec3(0.7, 0.7, 0.1)), VoxelLabel::Occupied) << z;
  }
}

TEST(MapBuilder, FreesTheVoxelsInWhichABoxStandsAndRoomBesideIt) {
  MapBuildOptions options = standing_at(Vec3(0, 0, 0.11));
  options.body = Body{box_corners(Box(Vec3(-0.3, -0.3, -0.1), Vec3(0.3, 0.3, 0.1))), 0.0};
  const VoxelMap map = build(ground(), options);
  EXPECT_EQ(label_at(map, Vec3(0.4, 0.4, 0.1)), VoxelLabel::Free);
  EXPECT_EQ(label_at(map, Vec3(0.6, 0.1, 0.1)), VoxelLabel::Occupied) << "0.2 m beside it";
  EXPECT_EQ(label_at(map, Vec3(0.1, 0.1, -0.1)), VoxelLabel::Occupied) << "the layer below";
}

TEST(MapBuilder, KeepsVoxelsThatTheVehicleTouchesOrInWhichItIsBuried) {
  EXPECT_EQ(build_map(ground(), standing_at(Vec3(0, 0, 0.55)))->stood_in, 0) << "touches exactly";
  EXPECT_EQ(build_map(ground(), standing_at(Vec3(0, 0, 0.1)))->stood_in, 0) << "0.45 m deep";
  EXPECT_EQ(build_map(ground(), standing_at(Vec3(0, 0, 1.5)))->stood_in, 0);
  EXPECT_EQ(build_map(sources_of({region("fog", Box(Vec3(-3, -3, -1), Vec3(3, 3, 3)))}), standing_at(Vec3(0, 0, 1)))
                ->stood_in,
            0)
      << "unknown voxels";
}

TEST(MapBuilder, EqualSourcesGiveTheSameVersion) {
  const MapSources sources = sources_of({region("water", BallRegion{Vec3(1, 2, 3), 1.5})});
  EXPECT_EQ(build(sources).version, build(sources).version);
  MapBuildOptions finer;
  finer.resolution = 0.2;
  EXPECT_NE(build(sources).version, build(sources, finer).version);
}

CloudLayer layer_of(PointCloud points) {
  CloudLayer layer;
  layer.points = std::move(points);
  layer.classes[2] = ClassMeaning{"ground", VoxelLabel::Occupied};
  layer.classes[6] = ClassMeaning{"building", VoxelLabel::Occupied};
  layer.classes[5] = ClassMeaning{"high_vegetation", VoxelLabel::Attractive};
  return layer;
}

VoxelMap build(CloudLayer layer) {
  MapSources sources;
  sources.clouds.push_back(std::move(layer));
  MapBuildOptions options;
  options.extents = Box(Vec3::Zero(), Vec3(4, 4, 4));
  options.background = VoxelLabel::Unknown;
  return build(sources, options);
}

TEST(CloudVoxels, MarkTheVoxelsOfTheirPoints) {
  const VoxelMap map = build(
      layer_of({{Vec3(1.1, 1.1, 1.1), 2}, {Vec3(2.1, 2.1, 2.1), 5}, {Vec3(3.1, 3.1, 3.1), 9}, {Vec3(9, 9, 9), 2}}));
  EXPECT_EQ(count(map, VoxelLabel::Occupied), 1);
  EXPECT_EQ(count(map, VoxelLabel::Attractive), 1);
  EXPECT_EQ(label_at(map, Vec3(1.2, 1.2, 1.2)), VoxelLabel::Occupied);
  EXPECT_EQ(label_at(map, Vec3(2.2, 2.2, 2.2)), VoxelLabel::Attractive);
  EXPECT_EQ(label_at(map, Vec3(3.1, 3.1, 3.1)), VoxelLabel::Unknown) << "a class without a meaning";
}

TEST(CloudVoxels, NeedTheirNumberOfPointsOfOneLabel) {
  CloudLayer layer = layer_of({{Vec3(1.1, 1.1, 1.1), 2},
                               {Vec3(1.2, 1.1, 1.1), 6},
                               {Vec3(1.2, 1.2, 1.1), 6},
                               {Vec3(2.1, 1.1, 1.1), 2},
                               {Vec3(2.2, 1.1, 1.1), 5},
                               {Vec3(2.2, 1.2, 1.1), 5}});
  layer.min_points = 3;
  EXPECT_EQ(count(build(layer), VoxelLabel::Occupied), 1) << "ground and building count together";
  layer.min_points = 2;
  const VoxelMap map = build(layer);
  EXPECT_EQ(label_at(map, Vec3(2.1, 1.1, 1.1)), VoxelLabel::Attractive);
  const auto at = static_cast<std::size_t>(map.grid.index(map.grid.cell_of(Vec3(1.1, 1.1, 1.1))));
  EXPECT_EQ(map.class_names[map.classes[at]], "building") << "the class with the most points";
}

TEST(CloudVoxels, FillTheColumnsBelow) {
  CloudLayer layer = layer_of({{Vec3(1.1, 1.1, 2.1), 6}, {Vec3(2.1, 1.1, 2.1), 2}});
  layer.fill_below[6] = true;
  const VoxelMap map = build(layer);
  for (double z = 0.1; z < 2.2; z += 0.25) EXPECT_EQ(label_at(map, Vec3(1.1, 1.1, z)), VoxelLabel::Occupied) << z;
  EXPECT_EQ(label_at(map, Vec3(1.1, 1.1, 2.3)), VoxelLabel::Unknown);
  EXPECT_EQ(label_at(map, Vec3(2.1, 1.1, 0.1)), VoxelLabel::Unknown);
}

TEST(CloudVoxels, ReachAsFarAsTheirRadius) {
  CloudLayer layer = layer_of({{Vec3(2.13, 2.02, 1.99), 2}, {Vec3(-0.2, 1, 1), 2}});
  layer.point_radius = 0.6;
  const VoxelMap map = build(layer);
  for (std::int64_t i = 0; i < map.grid.voxels(); ++i) {
    const Vec3 c = map.grid.centre(map.grid.cell(i));
    const bool near = (c - layer.points[0].position).norm() <= 0.6 || (c - layer.points[1].position).norm() <= 0.6;
    EXPECT_EQ(map.labels[static_cast<std::size_t>(i)] == VoxelLabel::Occupied, near) << c.transpose();
  }
}

}  // namespace
}  // namespace tern
