// Messages that draw in Foxglove: foxglove_msgs (https://docs.foxglove.dev/docs/sdk/schemas), fields as in its ROS 2
// package.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "ros_messages/types.h"

namespace tern::ros {

struct Color {
  static constexpr const char* kName = "foxglove_msgs/msg/Color";
  double r = 0.0, g = 0.0, b = 0.0, a = 0.0;
  static void fields(auto& m, auto& visit) {
    visit("r", m.r);
    visit("g", m.g);
    visit("b", m.b);
    visit("a", m.a);
  }
};
struct KeyValuePair {
  static constexpr const char* kName = "foxglove_msgs/msg/KeyValuePair";
  std::string key, value;
  static void fields(auto& m, auto& visit) {
    visit("key", m.key);
    visit("value", m.value);
  }
};
struct ArrowPrimitive {
  static constexpr const char* kName = "foxglove_msgs/msg/ArrowPrimitive";
  Pose pose;
  double shaft_length = 0.0, shaft_diameter = 0.0, head_length = 0.0, head_diameter = 0.0;
  Color color;
  static void fields(auto& m, auto& visit) {
    visit("pose", m.pose);
    visit("shaft_length", m.shaft_length);
    visit("shaft_diameter", m.shaft_diameter);
    visit("head_length", m.head_length);
    visit("head_diameter", m.head_diameter);
    visit("color", m.color);
  }
};
struct CubePrimitive {
  static constexpr const char* kName = "foxglove_msgs/msg/CubePrimitive";
  Pose pose;
  Vector3 size;
  Color color;
  static void fields(auto& m, auto& visit) {
    visit("pose", m.pose);
    visit("size", m.size);
    visit("color", m.color);
  }
};
struct SpherePrimitive {
  static constexpr const char* kName = "foxglove_msgs/msg/SpherePrimitive";
  Pose pose;
  Vector3 size;
  Color color;
  static void fields(auto& m, auto& visit) {
    visit("pose", m.pose);
    visit("size", m.size);
    visit("color", m.color);
  }
};
struct CylinderPrimitive {
  static constexpr const char* kName = "foxglove_msgs/msg/CylinderPrimitive";
  Pose pose;
  Vector3 size;
  double bottom_scale = 1.0, top_scale = 1.0;
  Color color;
  static void fields(auto& m, auto& visit) {
    visit("pose", m.pose);
    visit("size", m.size);
    visit("bottom_scale", m.bottom_scale);
    visit("top_scale", m.top_scale);
    visit("color", m.color);
  }
};
/// A line; type 0 joins its points in turn.
struct LinePrimitive {
  static constexpr const char* kName = "foxglove_msgs/msg/LinePrimitive";
  std::uint8_t type = 0;
  Pose pose;
  double thickness = 1.0;
  bool scale_invariant = false;
  std::vector<Point> points;
  Color color;
  std::vector<Color> colors;
  std::vector<std::uint32_t> indices;
  static void fields(auto& m, auto& visit) {
    visit("type", m.type);
    visit("pose", m.pose);
    visit("thickness", m.thickness);
    visit("scale_invariant", m.scale_invariant);
    visit("points", m.points);
    visit("color", m.color);
    visit("colors", m.colors);
    visit("indices", m.indices);
  }
};
struct TriangleListPrimitive {
  static constexpr const char* kName = "foxglove_msgs/msg/TriangleListPrimitive";
  Pose pose;
  std::vector<Point> points;
  Color color;
  std::vector<Color> colors;
  std::vector<std::uint32_t> indices;
  static void fields(auto& m, auto& visit) {
    visit("pose", m.pose);
    visit("points", m.points);
    visit("color", m.color);
    visit("colors", m.colors);
    visit("indices", m.indices);
  }
};
struct TextPrimitive {
  static constexpr const char* kName = "foxglove_msgs/msg/TextPrimitive";
  Pose pose;
  bool billboard = false;
  double font_size = 14.0;
  bool scale_invariant = false;
  Color color;
  std::string text;
  static void fields(auto& m, auto& visit) {
    visit("pose", m.pose);
    visit("billboard", m.billboard);
    visit("font_size", m.font_size);
    visit("scale_invariant", m.scale_invariant);
    visit("color", m.color);
    visit("text", m.text);
  }
};
struct ModelPrimitive {
  static constexpr const char* kName = "foxglove_msgs/msg/ModelPrimitive";
  Pose pose;
  Vector3 scale;
  Color color;
  bool override_color = false;
  std::string url, media_type;
  std::vector<std::uint8_t> data;
  static void fields(auto& m, auto& visit) {
    visit("pose", m.pose);
    visit("scale", m.scale);
    visit("color", m.color);
    visit("override_color", m.override_color);
    visit("url", m.url);
    visit("media_type", m.media_type);
    visit("data", m.data);
  }
};
/// Deletes the entity `id` of the same topic (type 0), or all of them (type 1).
struct SceneEntityDeletion {
  static constexpr const char* kName = "foxglove_msgs/msg/SceneEntityDeletion";
  Time timestamp;
  std::uint8_t type = 0;
  std::string id;
  static void fields(auto& m, auto& visit) {
    visit("timestamp", m.timestamp);
    visit("type", m.type);
    visit("id", m.id);
  }
};
/// Shapes in one frame. It replaces the entity with the same `id` on the same topic.
struct SceneEntity {
  static constexpr const char* kName = "foxglove_msgs/msg/SceneEntity";
  Time timestamp;
  std::string frame_id, id;
  Span lifetime;
  bool frame_locked = false;
  std::vector<KeyValuePair> metadata;
  std::vector<ArrowPrimitive> arrows;
  std::vector<CubePrimitive> cubes;
  std::vector<SpherePrimitive> spheres;
  std::vector<CylinderPrimitive> cylinders;
  std::vector<LinePrimitive> lines;
  std::vector<TriangleListPrimitive> triangles;
  std::vector<TextPrimitive> texts;
  std::vector<ModelPrimitive> models;
  static void fields(auto& m, auto& visit) {
    visit("timestamp", m.timestamp);
    visit("frame_id", m.frame_id);
    visit("id", m.id);
    visit("lifetime", m.lifetime);
    visit("frame_locked", m.frame_locked);
    visit("metadata", m.metadata);
    visit("arrows", m.arrows);
    visit("cubes", m.cubes);
    visit("spheres", m.spheres);
    visit("cylinders", m.cylinders);
    visit("lines", m.lines);
    visit("triangles", m.triangles);
    visit("texts", m.texts);
    visit("models", m.models);
  }
};
struct SceneUpdate {
  static constexpr const char* kName = "foxglove_msgs/msg/SceneUpdate";
  std::vector<SceneEntityDeletion> deletions;
  std::vector<SceneEntity> entities;
  static void fields(auto& m, auto& visit) {
    visit("deletions", m.deletions);
    visit("entities", m.entities);
  }
};

}  // namespace tern::ros
