// Scenes as RViz's markers.
#include "ros_messages/markers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "ros_messages/feed.h"

namespace tern::ros {
namespace {

Point operator-(const Point& a, const Point& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
double dot(const Point& a, const Point& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Point cross(const Point& a, const Point& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// A closed surface with outward triangles: its divergence gives the volume, and each triangle faces away from the
/// centre.
TEST(Markers, CubesAreClosedAndFaceOutwards) {
  SceneUpdate scene;
  SceneEntity& entity = scene.entities.emplace_back();
  entity.id = "obstacles";
  entity.frame_id = "map";
  entity.cubes.push_back({{{10.0, -3.0, 2.0}, {}}, {2.0, 3.0, 4.0}, {1.0, 0.5, 0.0, 1.0}});
  const MarkerArray array = markers_of(scene);
  ASSERT_EQ(array.markers.size(), 1U);
  const Marker& marker = array.markers[0];
  EXPECT_EQ(marker.type, Marker::kTriangles);
  EXPECT_EQ(marker.ns, "obstacles");
  EXPECT_EQ(marker.header.frame_id, "map");
  ASSERT_EQ(marker.points.size(), 36U);
  EXPECT_EQ(marker.colors.size(), marker.points.size());
  double volume = 0.0;
  for (std::size_t k = 0; k < marker.points.size(); k += 3) {
    const Point a = marker.points[k], b = marker.points[k + 1], c = marker.points[k + 2];
    EXPECT_GT(dot(cross(b - a, c - a), a - Point{10.0, -3.0, 2.0}), 0.0);
    volume += dot(a - Point{10.0, -3.0, 2.0}, cross(b - Point{10.0, -3.0, 2.0}, c - Point{10.0, -3.0, 2.0})) / 6.0;
  }
  EXPECT_NEAR(volume, 24.0, 1e-12);
}

TEST(Markers, ReplaceWhatALaterSceneLacks) {
  SceneUpdate scene;
  scene.entities.emplace_back().id = "hulls";
  scene.entities[0].triangles.emplace_back();
  const MarkerArray array = markers_of(scene);
  ASSERT_EQ(array.markers.size(), 2U);
  for (const Marker& marker : array.markers) EXPECT_EQ(marker.action, Marker::kDelete) << "a list of none";
  scene.deletions.push_back({{}, 1, ""});
  EXPECT_EQ(markers_of(scene).markers[0].action, Marker::kDeleteAll);
}

TEST(Markers, AreWrittenInThePlaceOfScenes) {
  const auto &scenes = feed_topics(), &markers = feed_topics(Drawings::Markers);
  ASSERT_EQ(scenes.size(), markers.size());
  for (std::size_t k = 0; k < scenes.size(); ++k) {
    EXPECT_EQ(scenes[k].name, markers[k].name);
    const bool draws = scenes[k].name.starts_with("/tern/");
    EXPECT_EQ(scenes[k].type == markers[k].type, !draws) << scenes[k].name;
  }
  std::string cdr;
  Feed feed(
      [&](const FeedTopic& topic, std::string bytes) {
        if (topic.name == topics::kCommittedLine) cdr = bytes;
      },
      [](std::string_view) { return true; }, {}, Drawings::Markers);
  HorizonRequest request;
  request.committed.control_points.row(0).setLinSpaced(7, 0.0, 6.0);
  feed.receive(request);
  const auto array = decode_cdr<MarkerArray>(std::vector<std::uint8_t>(cdr.begin(), cdr.end()));
  ASSERT_TRUE(array);
  EXPECT_EQ(array->markers.back().type, Marker::kLineStrip);
  EXPECT_EQ(array->markers.back().points.size(), 33U);
}

}  // namespace
}  // namespace tern::ros
