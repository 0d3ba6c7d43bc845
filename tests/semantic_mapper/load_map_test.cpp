#include "semantic_mapper/app/load_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "runtime/scenario_file.h"
#include "tests/support/cloud_files.h"

namespace tern {
namespace {

using testing::HasSubstr;

constexpr const char* kRegions = R"(
uav: {start: [0, 0, 1], goal: [9, 0, 1], flight_box: {min: [-1, -3, 0], max: [10, 3, 4]}}
semantics:
  classes: {texture: attractive, water: repulsive, wall: occupied}
  regions:
    - {name: a, class: texture, box: {min: [1, 1, 0], max: [2, 2, 1]}}
    - {name: b, class: water, ball: {centre: [5, 0, 1], radius: 1}}
    - {name: c, class: wall, prism: {corners: [[7, 0], [8, 0], [8, 1]], z_min: 0, z_max: 1}}
)";

/// A temporary folder with files.
class LoadMapTest : public ::testing::Test {
 protected:
  LoadMapTest() : folder_(std::filesystem::temp_directory_path() / ("tern_load_map_test_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_ / "data");
  }
  ~LoadMapTest() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& name, const support::FileBytes& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), std::ssize(bytes));
  }
  [[nodiscard]] VoxelMap load(const std::string& yaml, const std::vector<std::string>& overrides = {}) const {
    auto document = ConfigDocument::parse(yaml, (folder_ / "s.yaml").string(), overrides);
    const Scenario scenario = read_scenario(document);
    return load_map(scenario, read_mapper_config(document.root().section("mapper")), (folder_ / "data").c_str());
  }
  [[nodiscard]] std::string error_of(const std::string& yaml) const {
    try {
      (void)load(yaml);
    } catch (const ConfigError& e) {
      return e.what();
    }
    return "";
  }

  std::filesystem::path folder_;
};

std::int64_t count(const VoxelMap& map, VoxelLabel label) {
  return std::count(map.labels.begin(), map.labels.end(), label);
}

TEST_F(LoadMapTest, LabelsTheRegionsByTheirClasses) {
  const VoxelMap map = load(kRegions);
  EXPECT_EQ(map.grid.bounds().min(), Vec3(-1, -3, 0));
  EXPECT_EQ(map.grid.bounds().max(), Vec3(10, 3, 4));
  EXPECT_EQ(count(map, VoxelLabel::Attractive), 64);
  EXPECT_GT(count(map, VoxelLabel::Repulsive), 200);
  EXPECT_GE(count(map, VoxelLabel::Occupied), 32);
  EXPECT_EQ(count(map, VoxelLabel::Unknown), 0);
}

TEST_F(LoadMapTest, KeepsOnlyWhatIsSolidWithSemanticsOff) {
  const VoxelMap map = load(kRegions, {"semantics.enabled=false"});
  EXPECT_EQ(count(map, VoxelLabel::Attractive) + count(map, VoxelLabel::Repulsive), 0);
  EXPECT_GE(count(map, VoxelLabel::Occupied), 32);
}

TEST_F(LoadMapTest, AWorldWithoutAnythingHasAFreeMap) {
  const VoxelMap map = load("{}");
  EXPECT_GE(map.grid.voxels(), 1);
  EXPECT_EQ(count(map, VoxelLabel::Free), map.grid.voxels());
  EXPECT_NE(map.version, 0u);
}

TEST_F(LoadMapTest, VoxelizesStaticObstaclesWhenAsked) {
  const std::string yaml =
      "world: {obstacles: [{centre: [1, 1, 1], half_extents: 0.5}, {centre: [5, 1, 1], motion: linear, velocity: [1, "
      "0, 0]}]}\n";
  EXPECT_EQ(count(load(yaml), VoxelLabel::Occupied), 0);
  EXPECT_EQ(count(load(yaml + "mapper: {voxelize_obstacles: true}\n"), VoxelLabel::Occupied), 64);
}

TEST_F(LoadMapTest, FindsFilesBesideTheScenarioThenInTheDataFolder) {
  const PointCloud one{{Vec3(0.1, 0.1, 0.1), 6}};
  const PointCloud two{{Vec3(0.1, 0.1, 0.1), 6}, {Vec3(2.1, 0.1, 0.1), 6}};
  write("data/cloud.las", support::las_file(two, {}));
  EXPECT_EQ(count(load("mapper: {sources: [{file: cloud.las}]}"), VoxelLabel::Occupied), 2);
  write("cloud.las", support::las_file(one, {}));
  EXPECT_EQ(count(load("mapper: {sources: [{file: cloud.las}]}"), VoxelLabel::Occupied), 1);
  write("data/cloud.ply", support::ply_file(two, support::PlyKind::Big));
  EXPECT_EQ(count(load("mapper: {sources: [{file: cloud.ply}]}"), VoxelLabel::Occupied), 2);
}

TEST_F(LoadMapTest, AClassThatIsNamedItselfOverrulesItsGroup) {
  const PointCloud plants{{Vec3(0.1, 0.1, 0.1), 3}, {Vec3(2.1, 0.1, 0.1), 5}};
  write("cloud.las", support::las_file(plants, {}));
  const VoxelMap map =
      load("mapper: {classes: {high_vegetation: occupied, vegetation: attractive}, sources: [{file: cloud.las}]}");
  EXPECT_EQ(count(map, VoxelLabel::Occupied), 1);
  EXPECT_EQ(count(map, VoxelLabel::Attractive), 1);
}

TEST_F(LoadMapTest, NamesTheFileThatIsMissingOrBroken) {
  EXPECT_THAT(error_of("mapper: {sources: [{file: no.las}]}"), HasSubstr("mapper.sources[0].file: no.las not found"));
  write("bad.las", {'L', 'A', 'S', 'F'});
  EXPECT_THAT(error_of("mapper: {sources: [{file: bad.las}]}"),
              HasSubstr("bad.las, offset 4: the file ends within the header"));
  EXPECT_THAT(error_of("mapper: {resolution_m: 0.01, extents: {min: [0, 0, 0], max: [100, 100, 100]}}"),
              HasSubstr("limit 200000000"));
}

}  // namespace
}  // namespace tern
