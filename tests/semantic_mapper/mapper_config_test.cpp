#include "semantic_mapper/app/mapper_config.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tern {
namespace {

using testing::HasSubstr;

MapperConfig read(const std::string& yaml) {
  return read_mapper_config(ConfigDocument::parse(yaml, "s.yaml").root().section("mapper"));
}

std::string error_of(const std::string& yaml) {
  try {
    read(yaml);
  } catch (const ConfigError& e) {
    return e.what();
  }
  return "";
}

TEST(MapperConfig, HasDefaults) {
  const MapperConfig config = read("{}");
  EXPECT_EQ(config.resolution, 0.25);
  EXPECT_FALSE(config.extents);
  EXPECT_EQ(config.background, VoxelLabel::Free);
  EXPECT_FALSE(config.voxelize_obstacles);
  EXPECT_TRUE(config.sources.empty());
  EXPECT_FALSE(config.classes.empty());
}

TEST(MapperConfig, ReadsEveryKey) {
  const MapperConfig config = read(R"(
mapper:
  resolution_m: 0.5
  extents: {min: [-1, -2, -3], max: [4, 5, 6]}
  background: unknown
  voxelize_obstacles: true
  classes: {building: occupied, vegetation: attractive, class_42: repulsive}
  sources:
    - {file: a.las, origin: [1, 2, 3], metres_per_unit: 0.3048, min_points: 2, point_radius_m: 0.3, fill_below: "building, tower"}
    - {file: b.ply}
    - {file: c.bin, format: ply}
)");
  EXPECT_EQ(config.resolution, 0.5);
  EXPECT_EQ(config.extents->max(), Vec3(4, 5, 6));
  EXPECT_EQ(config.background, VoxelLabel::Unknown);
  EXPECT_TRUE(config.voxelize_obstacles);
  ASSERT_EQ(config.classes.size(), 3u);
  EXPECT_EQ(config.classes[2].second, VoxelLabel::Repulsive);
  ASSERT_EQ(config.sources.size(), 3u);
  EXPECT_EQ(config.sources[0].format, CloudFormat::Las);
  EXPECT_EQ(config.sources[0].frame.origin, Vec3(1, 2, 3));
  EXPECT_EQ(config.sources[0].frame.metres_per_unit, 0.3048);
  EXPECT_EQ(config.sources[0].min_points, 2);
  EXPECT_EQ(config.sources[0].point_radius, 0.3);
  EXPECT_THAT(config.sources[0].fill_below, testing::ElementsAre("building", "tower"));
  EXPECT_EQ(config.sources[1].format, CloudFormat::Ply);
  EXPECT_EQ(config.sources[2].format, CloudFormat::Ply);
}

TEST(MapperConfig, KnowsTheFormatByTheEndingAndRefusesKeysThatItHasNoUseFor) {
  const MapperConfig config =
      read("mapper: {sources: [{file: a.PCD, label: sem}, {file: b.xyz}, {file: c.bt}, {file: d.csv}, {file: e.ot}]}");
  EXPECT_EQ(config.sources[0].format, CloudFormat::Pcd);
  EXPECT_EQ(config.sources[0].label, "sem");
  EXPECT_EQ(config.sources[1].format, CloudFormat::Text);
  EXPECT_EQ(config.sources[2].format, CloudFormat::OctoMap);
  EXPECT_EQ(config.sources[3].format, CloudFormat::Text);
  EXPECT_EQ(config.sources[4].format, CloudFormat::OctoMap);
  EXPECT_EQ(config.background, VoxelLabel::Unknown) << "an OctoMap says what is free";
  EXPECT_EQ(read("mapper: {background: free, sources: [{file: c.bt}]}").background, VoxelLabel::Free);
  for (const char* key :
       {"label: a", "classes: {ground: free}", "min_points: 2", "point_radius_m: 1", "fill_below: wire"}) {
    EXPECT_THAT(error_of(std::string("mapper: {sources: [{file: c.bt, ") + key + "}]}"),
                HasSubstr("is a key for points; an OctoMap has none"));
  }
}

TEST(MapperConfig, RefusesWhatItDoesNotKnow) {
  EXPECT_THAT(error_of("mapper: {resolution_m: 0}"), HasSubstr("mapper.resolution_m: 0 is out of range"));
  EXPECT_THAT(error_of("mapper: {resolution: 1}"), HasSubstr("resolution"));
  EXPECT_THAT(error_of("mapper: {classes: {lava: repulsive}}"), HasSubstr("mapper.classes.lava: is not a class"));
  EXPECT_THAT(error_of("mapper: {classes: {ground: hot}}"), HasSubstr("mapper.classes.ground"));
  EXPECT_THAT(error_of("mapper: {background: occupied}"), HasSubstr("mapper.background"));
  EXPECT_THAT(error_of("mapper: {extents: {min: [0, 0, 0], max: [1, 0, 1]}}"),
              HasSubstr("must be greater than min on every axis"));
  EXPECT_THAT(error_of("mapper: {sources: [{format: las}]}"), HasSubstr("file"));
  EXPECT_THAT(error_of("mapper: {sources: [{file: a.las, fill_below: lava}]}"), HasSubstr("lava is not a class"));
  EXPECT_THAT(error_of("mapper: {sources: [{file: a.xyz, format: xyz}]}"), HasSubstr("format"));
}

}  // namespace
}  // namespace tern
