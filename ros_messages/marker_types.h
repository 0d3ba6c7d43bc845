// Messages that draw in RViz: visualization_msgs and what is in them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ros_messages/types.h"

namespace tern::ros {

struct ColorRGBA {
  static constexpr const char* kName = "std_msgs/msg/ColorRGBA";
  float r = 0.0F, g = 0.0F, b = 0.0F, a = 0.0F;
  static void fields(auto& m, auto& visit) {
    visit("r", m.r);
    visit("g", m.g);
    visit("b", m.b);
    visit("a", m.a);
  }
};
struct CompressedImage {
  static constexpr const char* kName = "sensor_msgs/msg/CompressedImage";
  Head header;
  std::string format;
  std::vector<std::uint8_t> data;
  static void fields(auto& m, auto& visit) {
    visit("header", m.header);
    visit("format", m.format);
    visit("data", m.data);
  }
};
struct UVCoordinate {
  static constexpr const char* kName = "visualization_msgs/msg/UVCoordinate";
  float u = 0.0F, v = 0.0F;
  static void fields(auto& m, auto& visit) {
    visit("u", m.u);
    visit("v", m.v);
  }
};
struct MeshFile {
  static constexpr const char* kName = "visualization_msgs/msg/MeshFile";
  std::string filename;
  std::vector<std::uint8_t> data;
  static void fields(auto& m, auto& visit) {
    visit("filename", m.filename);
    visit("data", m.data);
  }
};
/// A shape. It replaces the one with the same `ns` and `id` on the same topic.
struct Marker {
  static constexpr const char* kName = "visualization_msgs/msg/Marker";
  static constexpr std::int32_t kLineStrip = 4, kText = 9, kTriangles = 11;  ///< type
  static constexpr std::int32_t kAdd = 0, kDelete = 2, kDeleteAll = 3;       ///< action
  Head header;
  std::string ns;
  std::int32_t id = 0, type = 0, action = kAdd;
  Pose pose;
  Vector3 scale;
  ColorRGBA color;
  Span lifetime;  ///< 0: for ever
  bool frame_locked = false;
  std::vector<Point> points;
  std::vector<ColorRGBA> colors;
  std::string texture_resource;
  CompressedImage texture;
  std::vector<UVCoordinate> uv_coordinates;
  std::string text, mesh_resource;
  MeshFile mesh_file;
  bool mesh_use_embedded_materials = false;
  static void fields(auto& m, auto& visit) {
    visit("header", m.header);
    visit("ns", m.ns);
    visit("id", m.id);
    visit("type", m.type);
    visit("action", m.action);
    visit("pose", m.pose);
    visit("scale", m.scale);
    visit("color", m.color);
    visit("lifetime", m.lifetime);
    visit("frame_locked", m.frame_locked);
    visit("points", m.points);
    visit("colors", m.colors);
    visit("texture_resource", m.texture_resource);
    visit("texture", m.texture);
    visit("uv_coordinates", m.uv_coordinates);
    visit("text", m.text);
    visit("mesh_resource", m.mesh_resource);
    visit("mesh_file", m.mesh_file);
    visit("mesh_use_embedded_materials", m.mesh_use_embedded_materials);
  }
};
struct MarkerArray {
  static constexpr const char* kName = "visualization_msgs/msg/MarkerArray";
  std::vector<Marker> markers;
  static void fields(auto& m, auto& visit) { visit("markers", m.markers); }
};

}  // namespace tern::ros
