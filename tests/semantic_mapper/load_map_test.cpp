#include "semantic_mapper/app/load_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
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
    return load_all(yaml, overrides).map;
  }
  [[nodiscard]] LoadedMap load_all(const std::string& yaml, const std::vector<std::string>& overrides = {}) const {
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

/// A wall across the way at x = 10 m: 61 × 31 points, 0.1 m apart.
PointCloud wall(std::uint8_t class_number, const Vec3& shift = Vec3::Zero()) {
  PointCloud points;
  for (int j = 0; j < 61; ++j) {
    for (int k = 0; k < 31; ++k) points.push_back({Vec3(10.05, 0.1 * j - 3.0, 0.1 * k) + shift, class_number});
  }
  return points;
}
constexpr const char* kWorld = "uav: {goal: [20, 0, 1], flight_box: {min: [-2, -6, 0], max: [24, 6, 4]}}\n";
std::string with_source(const std::string& source, const std::string& more = "") {
  return kWorld + ("mapper: {" + more + "sources: [{" + source + "}]}");
}

TEST_F(LoadMapTest, ACloudWithoutLabelsIsOccupied) {
  write("plain.ply", support::ply_file(wall(9), support::PlyKind::Little, "intensity"));
  EXPECT_GT(count(load(with_source("file: plain.ply")), VoxelLabel::Occupied), 250);
  for (const std::uint8_t number : {std::uint8_t{0}, std::uint8_t{1}}) {
    write("plain.las", support::las_file(wall(number), {}));
    const LoadedMap loaded = load_all(with_source("file: plain.las"));
    EXPECT_GT(count(loaded.map, VoxelLabel::Occupied), 250);
    EXPECT_THAT(loaded.remarks.at(0).text, HasSubstr("1891 points, 1891 of them used: unlabelled"));
    EXPECT_GT(count(load(with_source("file: plain.las"), {"semantics.enabled=false"}), VoxelLabel::Occupied), 250);
  }
  EXPECT_EQ(count(load(with_source("file: plain.las", "classes: {class_1: attractive}, ")), VoxelLabel::Occupied), 0);
}

TEST_F(LoadMapTest, ACloudThatMarksNoVoxelIsRefusedWithWhatItHolds) {
  write("roads.las", support::las_file(wall(11), {}));
  EXPECT_THAT(error_of(with_source("file: roads.las")),
              testing::AllOf(HasSubstr("mapper.sources[0].file: roads.las: 1891 points, but none marks a voxel"),
                             HasSubstr("classes present: road_surface (11) 1891")));
  write("zero.ply", support::ply_file(wall(0), support::PlyKind::Ascii));
  EXPECT_THAT(error_of(with_source("file: zero.ply")),
              testing::AllOf(HasSubstr("never_classified (0) 1891"),
                             HasSubstr("the file's properties: x, y, z, other, label")));
  write("far.ply", support::ply_file(wall(6, Vec3(700, 0, 0)), support::PlyKind::Big));
  EXPECT_THAT(error_of(with_source("file: far.ply")),
              testing::AllOf(HasSubstr("no point lies in or near uav.flight_box"), HasSubstr("(710.05, -3, 0)")));
  EXPECT_THAT(error_of(with_source("file: far.ply", "extents: {min: [-2, -6, 0], max: [24, 6, 4]}, ")),
              HasSubstr("no point lies inside mapper.extents"));
  write("utm.xyz", support::text_file(wall(6, Vec3(465000, 5572094, 300))));
  EXPECT_THAT(
      error_of(with_source("file: utm.xyz")),
      HasSubstr("1891 lie beyond 1e+06 m of the world's origin, the first at (465010.05, 5572091, 300) in the file"));
  write("empty.las", support::las_file({}, {}));
  EXPECT_THAT(error_of(with_source("file: empty.las")), HasSubstr("0 points, but none marks a voxel"));
  write("wall.las", support::las_file(wall(6), {}));
  EXPECT_THAT(error_of(with_source("file: wall.las, min_points: 1000")),
              HasSubstr("min_points: no voxel has 1000 marks of one label"));
}

TEST_F(LoadMapTest, ASourceBesideTheFlightBoxIsUsedOnlyIfExtentsReachFromTheBoxToIt) {
  const auto warns_of = [](const char* text) {
    return testing::Contains(testing::AllOf(testing::Field(&MapRemark::text, HasSubstr(text)),
                                            testing::Field(&MapRemark::is_warning, true)));
  };
  const std::string both = "extents: {min: [-2, -6, 0], max: [24, 6, 16]}, ";
  const std::string apart = "extents: {min: [-2, -6, 7], max: [24, 6, 16]}, ";
  write("leaves.ply", support::ply_file(wall(6, Vec3(0, 0, 8)), support::PlyKind::Little));
  const LoadedMap leaves = load_all(with_source("file: leaves.ply", both));
  EXPECT_GT(count(leaves.map, VoxelLabel::Occupied), 250);
  EXPECT_THAT(leaves.remarks,
              warns_of("no point lies in or near uav.flight_box: the cloud reaches from (10.05, -3, 8)"));
  EXPECT_THAT(error_of(with_source("file: leaves.ply")),
              HasSubstr("a cloud beside the box needs mapper.extents that contain both"));
  EXPECT_THAT(error_of(with_source("file: leaves.ply", apart)), HasSubstr("no point lies in or near uav.flight_box"));
  EXPECT_THAT(error_of(with_source("file: leaves.ply, origin: [0, 0, 30]", both)),
              HasSubstr("no point lies inside mapper.extents"))
      << "another frame";

  write("roof.bt", support::octomap_file(std::vector<VoxelLabel>(8, VoxelLabel::Occupied), 2, true));
  const std::string roof = "file: roof.bt, origin: [-5, 0, -8]";
  const LoadedMap roofed = load_all(with_source(roof, both));
  EXPECT_GT(count(roofed.map, VoxelLabel::Occupied), 0);
  EXPECT_THAT(roofed.remarks, warns_of("no cube lies in or near uav.flight_box"));
  EXPECT_THAT(error_of(with_source(roof)), HasSubstr("none lies in or near uav.flight_box"));
  EXPECT_THAT(error_of(with_source(roof, apart)), HasSubstr("none lies in or near uav.flight_box"));
  EXPECT_THAT(error_of(with_source("file: roof.bt, origin: [0, 0, 30]", both)), HasSubstr("inside mapper.extents"));
}

TEST_F(LoadMapTest, ASourceNamesItsClassPropertyAndWhatItsNumbersMean) {
  write("rue.ply", support::ply_file(wall(4), support::PlyKind::Big, "sem_class"));
  EXPECT_GT(count(load(with_source("file: rue.ply, label: sem_class, classes: {4: repulsive}")), VoxelLabel::Repulsive),
            250);
  EXPECT_GT(count(load(with_source("file: rue.ply, label: sem_class")), VoxelLabel::Attractive), 250) << "vegetation";
  EXPECT_THAT(error_of(with_source("file: rue.ply, label: label")), HasSubstr("no property label for the class among"));
  EXPECT_THAT(error_of(with_source("file: rue.ply, classes: {256: occupied}")), HasSubstr("is not a class"));
  write("wall.las", support::las_file(wall(6), {}));
  EXPECT_THAT(error_of(with_source("file: wall.las, label: class")), HasSubstr("LAS files have none"));
}

TEST_F(LoadMapTest, WarnsOfWhatIsLeftOutAndOfCoordinatesThatAreTooLarge) {
  PointCloud points = wall(6);
  for (std::size_t i = 0; i < 38; ++i) points[50 * i].position.x() = std::nan("");
  write("holes.ply", support::ply_file(points, support::PlyKind::Little));
  const auto remarks = load_all(with_source("file: holes.ply")).remarks;
  ASSERT_EQ(remarks.size(), 2u);
  EXPECT_TRUE(remarks[1].is_warning);
  EXPECT_THAT(remarks[1].text, HasSubstr("of 1891 points 38 are not finite; they are left out"));
  // z is a float32 in these files: 5.6e6 is exact to 0.5 m.
  write("survey.ply", support::ply_file(wall(6, Vec3(0, 0, 5'572'094)), support::PlyKind::Little));
  const auto survey = load_all(with_source("file: survey.ply, origin: [0, 0, 5572094]")).remarks;
  ASSERT_EQ(survey.size(), 2u);
  EXPECT_TRUE(survey[1].is_warning);
  EXPECT_THAT(survey[1].text, HasSubstr("float32 coordinates are exact to 0.5 m, and voxels have 0.25 m"));
}

TEST_F(LoadMapTest, UnclassifiedPointsAmongClassifiedOnesAreOccupiedUnlessClassesAreGiven) {
  PointCloud points = wall(1);
  points.push_back({Vec3(1, 1, 0), 2});
  write("mixed.las", support::las_file(points, {}));
  const LoadedMap by_default = load_all(with_source("file: mixed.las"));
  EXPECT_EQ(by_default.remarks.size(), 1u);
  EXPECT_GT(count(by_default.map, VoxelLabel::Occupied), 250);
  const LoadedMap chosen = load_all(with_source("file: mixed.las", "classes: {ground: occupied}, "));
  ASSERT_EQ(chosen.remarks.size(), 2u);
  EXPECT_TRUE(chosen.remarks[1].is_warning);
  EXPECT_THAT(chosen.remarks[1].text, HasSubstr("1891 points in or near uav.flight_box have class 0 or 1"));
  EXPECT_EQ(count(chosen.map, VoxelLabel::Occupied), 1);
  const LoadedMap named = load_all(with_source("file: mixed.las, classes: {1: occupied}"));
  EXPECT_EQ(named.remarks.size(), 1u);
  EXPECT_GT(count(named.map, VoxelLabel::Occupied), 250);
}

TEST_F(LoadMapTest, LabelsOfMinusOneAreLeftOutAndCounted) {
  std::string text =
      "ply\r\nformat ascii 1.0\r\nelement vertex 3\r\nproperty float x\r\nproperty float y\r\n"
      "property float z\r\nproperty int label\r\nend_header\r\n"
      "10 0 1 6\r\n10 0 1.5 -1\r\nnan 0 1 6\r\n";
  write("none.ply", {text.begin(), text.end()});
  const LoadedMap loaded = load_all(with_source("file: none.ply"));
  EXPECT_EQ(count(loaded.map, VoxelLabel::Occupied), 1);
  EXPECT_THAT(loaded.remarks.at(1).text,
              HasSubstr("of 3 points 1 are not finite, 1 have a label that is no class number (0 to 255)"));
}

TEST_F(LoadMapTest, AVehicleThatStandsOnScannedGroundIsNotInTheMap) {
  PointCloud ground;
  for (int i = 0; i < 60; ++i) {
    for (int j = 0; j < 30; ++j) {
      ground.push_back({Vec3(0.2 * i - 2.0, 0.2 * j - 3.0, 0.02 * ((i + j) % 3 - 1)), 2});
    }
  }
  write("ground.las", support::las_file(ground, {}));
  const std::string rest =
      ", goal: [9, 0, 1], body: {radius: 0.3}, flight_box: {min: [-2, -3, -1], max: [12, 3, 4]}}\n"
      "mapper: {sources: [{file: ground.las}]}";
  const LoadedMap stands = load_all("uav: {start: [0, 0, 0.32]" + rest);
  EXPECT_THAT(stands.remarks.back().text, HasSubstr("stands in"));
  const LoadedMap touches = load_all("uav: {start: [0, 0, 0.55]" + rest);
  EXPECT_EQ(touches.remarks.size(), 1u);
  EXPECT_GT(count(touches.map, VoxelLabel::Occupied), count(stands.map, VoxelLabel::Occupied));
}

TEST_F(LoadMapTest, AFileOfAnotherFormatIsNamedAsSuch) {
  EXPECT_THAT(error_of(with_source("file: wall.e57")),
              HasSubstr("wall.e57: files named *.e57 are not read; LAS (*.las"));
  EXPECT_THAT(error_of(with_source("file: wall")), HasSubstr("wall: files without an ending are not read"));
  EXPECT_THAT(error_of(with_source("file: wall.e57, format: ply")), HasSubstr("wall.e57 not found"));
  EXPECT_THAT(error_of(with_source("file: wall.e57, format: stl")), HasSubstr("format"));
}

TEST_F(LoadMapTest, AllFormatsOfOneCloudGiveTheSameMap) {
  const PointCloud points = wall(6);
  write("wall.las", support::las_file(points, {}));
  write("wall.ply", support::ply_file(points, support::PlyKind::Big));
  write("wall.xyz", support::text_file(points));
  write("ascii.pcd", support::pcd_file(points, support::PcdKind::Ascii));
  write("binary.pcd", support::pcd_file(points, support::PcdKind::Binary));
  write("compressed.pcd", support::pcd_file(points, support::PcdKind::Compressed));
  const VoxelMap map = load(with_source("file: wall.las"));
  EXPECT_GT(count(map, VoxelLabel::Occupied), 250);
  for (const char* file : {"wall.ply", "wall.xyz", "ascii.pcd", "binary.pcd", "compressed.pcd"}) {
    EXPECT_EQ(load(with_source(std::string("file: ") + file)).version, map.version) << file;
  }
}

TEST_F(LoadMapTest, AnOctoMapHasOccupiedFreeAndUnknownVoxels) {
  std::vector<VoxelLabel> labels(8 * 8 * 8, VoxelLabel::Free);
  for (int i = 0; i < 64; ++i) labels[idx(4 + 8 * i)] = VoxelLabel::Occupied;  // a wall at x = 2 to 2.5 m
  for (int i = 0; i < 64; ++i) labels[idx(7 + 8 * i)] = VoxelLabel::Unknown;
  write("lab.bt", support::octomap_file(labels, 8, true));
  write("lab.ot", support::octomap_file(labels, 8, false));
  const std::string more = "resolution_m: 0.5, ";
  const LoadedMap loaded = load_all(with_source("file: lab.bt", more));
  EXPECT_EQ(count(loaded.map, VoxelLabel::Occupied), 64);
  EXPECT_EQ(count(loaded.map, VoxelLabel::Free), 6 * 64);
  EXPECT_EQ(count(loaded.map, VoxelLabel::Unknown), loaded.map.grid.voxels() - 7 * 64);
  EXPECT_EQ(loaded.remarks.size(), 1u);
  EXPECT_THAT(loaded.remarks[0].text, HasSubstr("64 occupied"));
  EXPECT_EQ(load(with_source("file: lab.ot", more)).version, loaded.map.version);
  EXPECT_EQ(count(load(with_source("file: lab.bt", more + "background: free, ")), VoxelLabel::Unknown), 0);
  EXPECT_THAT(load_all(with_source("file: lab.bt", "resolution_m: 1, ")).remarks.at(1).text,
              HasSubstr("`mapper.resolution_m: 0.5` keeps its shape"));
  EXPECT_THAT(error_of(with_source("file: lab.bt, origin: [500, 0, 0]")),
              HasSubstr("none lies in or near uav.flight_box: check origin and metres_per_unit"));
}

}  // namespace
}  // namespace tern
