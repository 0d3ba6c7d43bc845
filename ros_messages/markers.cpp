#include "ros_messages/markers.h"

#include <array>
#include <cmath>
#include <utility>

namespace tern::ros {
namespace {

constexpr double kTextHeight = 0.4;                                                     // m
constexpr std::int32_t kCubes = 0, kLines = 1'000, kTriangles = 2'000, kTexts = 3'000;  // first ids
constexpr std::uint8_t kAllEntities = 1;

ColorRGBA color_of(const Color& c) {
  return {static_cast<float>(c.r), static_cast<float>(c.g), static_cast<float>(c.b), static_cast<float>(c.a)};
}

Marker marker(const SceneEntity& entity, std::int32_t id, std::int32_t type, const Color& color) {
  Marker out;
  out.header = {entity.timestamp, entity.frame_id};
  out.ns = entity.id;
  out.id = id;
  out.type = type;
  out.scale = {1.0, 1.0, 1.0};
  out.color = color_of(color);
  out.lifetime = entity.lifetime;
  return out;
}

/// Adds the twelve triangles of a cube that is not turned.
void add_cube(std::vector<Point>& points, const CubePrimitive& cube) {
  static constexpr std::array<std::array<int, 4>, 6> kFaces{
      {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}}};
  const auto corner = [&](int k) {
    const Point& c = cube.pose.position;
    return Point{c.x + ((k & 4) != 0 ? 0.5 : -0.5) * cube.size.x, c.y + ((k & 2) != 0 ? 0.5 : -0.5) * cube.size.y,
                 c.z + ((k & 1) != 0 ? 0.5 : -0.5) * cube.size.z};
  };
  for (const auto& [a, b, c, d] : kFaces) {
    for (const int k : {a, b, c, a, c, d}) points.push_back(corner(k));
  }
}

void add_markers(std::vector<Marker>& markers, const SceneEntity& entity) {
  Marker cubes = marker(entity, kCubes, Marker::kTriangles, entity.cubes.empty() ? Color() : entity.cubes[0].color);
  for (const CubePrimitive& cube : entity.cubes) {
    add_cube(cubes.points, cube);
    cubes.colors.insert(cubes.colors.end(), 36, color_of(cube.color));
  }
  if (entity.cubes.empty()) cubes.action = Marker::kDelete;
  markers.push_back(std::move(cubes));
  std::int32_t id = kLines;
  for (const LinePrimitive& line : entity.lines) {
    Marker& out = markers.emplace_back(marker(entity, id++, Marker::kLineStrip, line.color));
    out.scale = {kMarkerLineWidth, 0.0, 0.0};
    out.points = line.points;
  }
  id = kTriangles;
  for (const TriangleListPrimitive& triangles : entity.triangles) {
    Marker& out = markers.emplace_back(marker(entity, id++, Marker::kTriangles, triangles.color));
    for (const std::uint32_t k : triangles.indices) out.points.push_back(triangles.points[k]);
    if (out.points.empty()) out.action = Marker::kDelete;  // RViz complains about a list of none
  }
  id = kTexts;
  for (const TextPrimitive& text : entity.texts) {
    Marker& out = markers.emplace_back(marker(entity, id++, Marker::kText, text.color));
    out.pose = text.pose;
    out.scale = {0.0, 0.0, kTextHeight};
    out.text = text.text;
  }
}

}  // namespace

MarkerArray markers_of(const SceneUpdate& scene) {
  MarkerArray array;
  for (const SceneEntityDeletion& deletion : scene.deletions) {
    if (deletion.type != kAllEntities) continue;
    Marker& out = array.markers.emplace_back();
    out.header.stamp = deletion.timestamp;
    out.action = Marker::kDeleteAll;
  }
  for (const SceneEntity& entity : scene.entities) add_markers(array.markers, entity);
  return array;
}

}  // namespace tern::ros
