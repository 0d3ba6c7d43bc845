// The files that tern-export writes of a flight, and the maps in them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include "core/drawing/hull_faces.h"
#include "core/geometry/convex_hull.h"
#include "core/world/box_cover.h"
#include "core/world/names.h"
#include "ros_messages/feed.h"
#include "ros_messages/message_types.h"
#include "ros_messages/own_messages.h"
#include "ros_messages/scene.h"
#include "tests/support/recorded_flight.h"
#include "tests/support/temp_folder.h"
#include "tests/tools/export/mcap_file.h"
#include "tools/export/export_log.h"
#include "tools/export/logged_messages.h"
#include "tools/export/mcap_writer.h"

namespace tern::exporting {
namespace {

using tern::testing::McapFile;
using tern::testing::McapMessage;
using tern::testing::parse_mcap;
using tern::testing::read_mcap;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Key;
using ::testing::Not;

/// One flight for all tests of this file.
class ExportedFlight : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TempFolder;
    const auto told = export_log({.log = log(), .csv_folder = "", .mcap_file = mcap(), .bag_folder = "", .suffix = ""});
    ASSERT_TRUE(told) << told.error().message;
  }
  static void TearDownTestSuite() { delete folder_; }
  static std::string log() { return tern::testing::recorded_log("crowded"); }
  static std::string mcap() { return folder_->file("flight.mcap"); }
  static ros::SceneUpdate scene_of(const McapMessage& message) {
    return ros::decode_cdr<ros::SceneUpdate>(message.cdr).value();
  }

  static inline TempFolder* folder_ = nullptr;
};

TEST_F(ExportedFlight, HoldsEveryMessageOfTheLogOnce) {
  std::map<std::string, std::uint64_t> logged;
  FlightLog reader("");
  on_every_channel(reader, "", [&](const LoggedMessage& message) { ++logged["/" + message.channel]; });
  ASSERT_TRUE(reader.read(log()));
  McapFile file = read_mcap(mcap());
  EXPECT_GT(file.chunks, 1);
  std::map<std::string, std::uint64_t> exported;
  for (const McapMessage& message : file.messages) {
    EXPECT_EQ(message.sequence, ++exported[message.topic]) << message.topic;
    EXPECT_LE(file.first_ns, message.log_ns);
    EXPECT_GE(file.last_ns, message.log_ns);
  }
  EXPECT_EQ(file.counted, exported);
  std::erase_if(exported, [&](const auto& topic) { return !logged.contains(topic.first); });
  EXPECT_EQ(exported, logged);
}

/// At most 5.7 MB for a flight of 14 s among 100 obstacles: three fifths of the same messages as JSON.
TEST_F(ExportedFlight, TakesNoMoreBytesThanAFlightMay) {
  constexpr double kMostBytesPerSecond = 0.6 * 9.5e6 / 14.0;
  const McapFile file = read_mcap(mcap());
  const double seconds = 1e-9 * static_cast<double>(file.last_ns - file.first_ns);
  const double bytes = static_cast<double>(std::filesystem::file_size(mcap()));
  EXPECT_GT(seconds, 1.0);
  EXPECT_LT(bytes / seconds, kMostBytesPerSecond) << bytes << " bytes in " << seconds << " s";
}

TEST_F(ExportedFlight, HasEveryTopicOfTheFeed) {
  const McapFile file = read_mcap(mcap());
  for (const ros::FeedTopic& topic : ros::feed_topics()) {
    if (topic.name == ros::topics::kSetpoint) continue;  // /SETPOINT says the same
    EXPECT_THAT(file.counted, Contains(Key(topic.name)));
    EXPECT_EQ(file.schemas.at(topic.type->name()), topic.type->definition());
  }
  EXPECT_EQ(file.counted.at("/odom"), file.counted.at("/UAV_STATE"));
  EXPECT_EQ(file.counted.at("/tern/regions"), 1U) << "the map is sent again and again, and drawn once";
  EXPECT_THAT(file.schemas.at("tern_msgs/msg/Plan"), HasSubstr("\nint8 outcome  # OPTIMIZED ... NO_PLAN\n"));
}

/// check_mcap.mjs reads every field by these definitions.
TEST_F(ExportedFlight, HasDefinitionsWithoutTypesOfLcm) {
  const McapFile file = read_mcap(mcap());
  for (const auto& [name, definition] : file.schemas) {
    for (const char* word : {"_t ", "int64_t", "double "}) EXPECT_THAT(definition, Not(HasSubstr(word))) << name;
  }
}

TEST_F(ExportedFlight, NamesTheClassOfEachRegion) {
  const McapFile file = read_mcap(mcap());
  const auto found = std::find_if(file.messages.begin(), file.messages.end(),
                                  [](const McapMessage& message) { return message.topic == "/tern/regions"; });
  ASSERT_NE(found, file.messages.end());
  std::map<std::string, std::string> labels;  // by class
  for (const ros::SceneEntity& entity : scene_of(*found).entities) {
    EXPECT_FALSE(entity.cubes.empty());
    labels[entity.metadata.at(1).value] = entity.metadata.at(0).value;
    EXPECT_EQ(entity.texts.at(0).text, entity.metadata.at(1).value);
  }
  EXPECT_EQ(labels, (std::map<std::string, std::string>{{"texture", "attractive"}, {"water", "repulsive"}}));
}

TEST_F(ExportedFlight, DrawsHullsAndPlanesOfEveryPlan) {
  const McapFile file = read_mcap(mcap());
  EXPECT_EQ(file.counted.at("/tern/hulls"), file.counted.at("/tern/plan"));
  EXPECT_EQ(file.counted.at("/tern/planes"), file.counted.at("/tern/plan"));
  std::size_t triangles = 0;
  for (const McapMessage& message : file.messages) {
    if (message.topic != "/tern/hulls" && message.topic != "/tern/planes") continue;
    const ros::SceneUpdate update = scene_of(message);
    const ros::TriangleListPrimitive& mesh = update.entities.at(0).triangles.at(0);
    ASSERT_EQ(mesh.indices.size() % 3, 0U);
    for (const auto& index : mesh.indices) ASSERT_LT(index, mesh.points.size());
    triangles += mesh.indices.size() / 3;
  }
  EXPECT_GT(triangles, 100U);
}

TEST_F(ExportedFlight, IsAFolderThatRosbag2Plays) {
  const TempFolder folder;
  const std::string bag = folder.file("flight");
  ASSERT_TRUE(export_log({.log = log(), .csv_folder = "", .mcap_file = "", .bag_folder = bag, .suffix = ""}));
  const McapFile file = read_mcap(bag + "/flight_0.mcap");
  std::ifstream in(bag + "/metadata.yaml");
  const std::string metadata{std::istreambuf_iterator<char>(in), {}};
  EXPECT_THAT(metadata, HasSubstr("    - \"flight_0.mcap\"\n"));
  EXPECT_THAT(metadata, HasSubstr("  message_count: " + std::to_string(file.messages.size()) + "\n"));
  EXPECT_THAT(metadata, HasSubstr("        name: /odom\n        type: nav_msgs/msg/Odometry\n"));
}

RC_GTEST_PROP(HullFaces, AreAClosedSurfaceWithEveryPointInside, ()) {
  const int n = *rc::gen::inRange(4, 30);
  Points points(3, n);
  for (int k = 0; k < n; ++k) {
    for (int axis = 0; axis < 3; ++axis) points(axis, k) = *rc::gen::inRange(-4, 5);  // coplanar faces are common
  }
  const Points vertices = hull_vertices(points);
  std::map<std::pair<int, int>, int> edges;
  for (const auto& face : hull_faces(vertices)) {
    const Vec3 a = vertices.col(face[0]), b = vertices.col(face[1]), c = vertices.col(face[2]);
    for (int k = 0; k < n; ++k) RC_ASSERT((b - a).cross(c - a).dot(points.col(k) - a) <= 1e-9);
    for (std::size_t k = 0; k < 3; ++k) ++edges[{face[k], face[(k + 1) % 3]}];
  }
  for (const auto& [edge, count] : edges) {
    RC_ASSERT(count == 1);
    RC_ASSERT(edges.contains({edge.second, edge.first}));
  }
  const Eigen::Matrix3Xd arms = points.colwise() - points.col(0);
  RC_ASSERT(edges.empty() == (arms.fullPivLu().rank() < 3));
}

TEST(MessageTypes, HaveNoUnitThatIsNotKnown) {
  const std::set<std::string> known = {"",    "m",     "m/s",   "m/s^2",   "m/s^3",   "m^2",
                                       "rad", "deg",   "deg/s", "m^2/s^5", "m^2/s^6", "s",
                                       "1/m", "1/m^2", "rad^2", "rad/s",   "rad/s^2", "m^2/s^2"};
  for (const auto& [name, type] : ros::message_types()) {
    for (const ros::MessageField& field : type.fields)
      EXPECT_TRUE(known.contains(field.unit)) << name << "." << field.name;
  }
}

TEST(McapReader, NoticesEveryChangedByteOfASmallFile) {
  const TempFolder folder;
  McapWriter writer(folder.file("a.mcap"));
  for (int k = 0; k < 3; ++k) writer.add("/clock", ros::ros_type<ros::Clock>(), k, ros::encode_cdr(ros::Clock{{k, 0}}));
  ASSERT_TRUE(writer.finish());
  std::ifstream in(folder.file("a.mcap"), std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  EXPECT_EQ(parse_mcap(bytes).messages.size(), 3U);
  for (std::size_t k = 0; k < bytes.size(); ++k) {
    std::string changed = bytes;
    changed[k] = static_cast<char>(changed[k] ^ 0x10);
    EXPECT_ANY_THROW(parse_mcap(changed)) << "byte " << k;
  }
}

TEST(McapWriter, SaysWhenItCannotWrite) {
  McapWriter writer("/nowhere/a.mcap");
  const auto written = writer.finish();
  ASSERT_FALSE(written);
  EXPECT_THAT(written.error().message, HasSubstr("/nowhere/a.mcap"));
}

Box box_of(const ros::CubePrimitive& cube) {
  const auto vector = [](const auto& v) { return Vec3(v.x, v.y, v.z); };
  const Vec3 centre = vector(cube.pose.position), half = 0.5 * vector(cube.size);
  return {Vec3(centre - half), Vec3(centre + half)};
}

RC_GTEST_PROP(MapRegions, CoverTheLabelledVoxelsOnceAndNothingElse, ()) {
  VoxelMap map;
  for (int axis = 0; axis < 3; ++axis) map.grid.size[axis] = *rc::gen::inRange(1, 7);
  const auto n = static_cast<std::size_t>(map.grid.voxels());
  map.class_names = {"", "a"};
  for (std::size_t k = 0; k < n; ++k) {
    map.labels.push_back(*rc::gen::weightedElement<VoxelLabel>(
        {{3, VoxelLabel::Free}, {6, VoxelLabel::Attractive}, {1, VoxelLabel::Occupied}}));
    map.classes.push_back(*rc::gen::weightedElement<std::uint8_t>({{1, 0}, {5, 1}}));
  }
  std::vector<int> covered(n, 0);
  const ros::SceneUpdate drawn = ros::SceneDrawing({}, UTime{0}).regions(map);
  for (const ros::SceneEntity& entity : drawn.entities) {
    for (const ros::CubePrimitive& cube : entity.cubes) {
      const Box box = box_of(cube);
      for (std::size_t k = 0; k < n; ++k) {
        if (!box.contains(map.grid.centre(map.grid.cell(static_cast<std::int64_t>(k))))) continue;
        ++covered[k];
        RC_ASSERT(to_string(map.labels[k]) == entity.metadata.at(0).value);
        RC_ASSERT(map.class_names[map.classes[k]] == entity.metadata.at(1).value);
      }
    }
  }
  for (std::size_t k = 0; k < n; ++k) RC_ASSERT(covered[k] == (map.labels[k] >= VoxelLabel::Occupied ? 1 : 0));
}

/// A wall of 1 × 9 voxels along y with a corner of 4 along x: two boxes, whichever is started with.
TEST(MapRegions, AreThePlannersBoxes) {
  VoxelMap map;
  map.grid.size = {5, 9, 1};
  map.labels.assign(45, VoxelLabel::Free);
  map.classes.assign(45, 0);
  map.class_names = {""};
  const auto fill = [&](int x, int y) {
    map.labels[static_cast<std::size_t>(map.grid.index({x, y, 0}))] = VoxelLabel::Occupied;
  };
  for (int y = 0; y < 9; ++y) fill(0, y);
  for (int x = 1; x < 5; ++x) fill(x, 0);
  const std::vector<Box> wanted = cover_with_boxes(map, false);
  const auto cubes = ros::SceneDrawing({}, UTime{0}).regions(map).entities.at(0).cubes;
  ASSERT_EQ(cubes.size(), wanted.size());
  for (std::size_t k = 0; k < wanted.size(); ++k) EXPECT_TRUE(box_of(cubes[k]).isApprox(wanted[k])) << "box " << k;
}

}  // namespace
}  // namespace tern::exporting
