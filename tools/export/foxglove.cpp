#include "tools/export/foxglove.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "core/splines/clamped_spline.h"
#include "core/world/box_cover.h"
#include "core/world/names.h"
#include "tools/export/hull_faces.h"
#include "viewer/bridge/plane_place.h"
#include "viewer/bridge/predicted_hulls.h"

namespace tern::exporting {
namespace {

constexpr int kSamplesPerInterval = 8;  ///< enough for a smooth curve
constexpr std::int64_t kNoPlan = 4;     // plan_t.NO_PLAN
constexpr char kFrame[] = "W";
constexpr char kScene[] = "foxglove.SceneUpdate";
constexpr double kHullReach = 3.0;  // m
constexpr int kMaxHulls = 60;
constexpr double kPatchSide = 1.0;  // m

Json time_of(std::int64_t us) { return {{"sec", us / 1'000'000}, {"nsec", us % 1'000'000 * 1000}}; }

Json pose(const Json& position, double yaw) {
  return {{"position", position},
          {"orientation", {{"x", 0.0}, {"y", 0.0}, {"z", std::sin(yaw / 2)}, {"w", std::cos(yaw / 2)}}}};
}

Json color(double r, double g, double b, double a) { return {{"r", r}, {"g", g}, {"b", b}, {"a", a}}; }

/// Rounds to 0.1 mm, which reduces the file to a third.
Json vector_of(const Vec3& p) {
  constexpr double kPerMetre = 1e4;
  const Vec3 q = (p * kPerMetre).array().round() / kPerMetre;
  return {{"x", q.x()}, {"y", q.y()}, {"z", q.z()}};
}

/// Returns an empty entity.
Json entity_of(std::int64_t received_us, const std::string& id) {
  Json entity{{"timestamp", time_of(received_us)},
              {"frame_id", kFrame},
              {"id", id},
              {"lifetime", time_of(0)},
              {"frame_locked", false}};
  for (const char* list :
       {"metadata", "arrows", "cubes", "spheres", "cylinders", "lines", "triangles", "texts", "models"}) {
    entity[list] = Json::array();
  }
  return entity;
}

/// Returns a scene of one entity with these shapes.
Json scene(std::int64_t received_us, const std::string& id, const char* list, const Json& shapes) {
  Json entity = entity_of(received_us, id);
  entity[list] = shapes;
  return {{"deletions", Json::array()}, {"entities", Json::array({entity})}};
}

/// Returns triangles of one colour.
struct Triangles {
  Json points = Json::array(), indices = Json::array();

  void add(const Points& corners, const std::vector<std::array<int, 3>>& faces) {
    const std::size_t first = points.size();
    for (Eigen::Index k = 0; k < corners.cols(); ++k) points.push_back(vector_of(corners.col(k)));
    for (const auto& face : faces) {
      for (const int corner : face) indices.push_back(first + idx(corner));
    }
  }
  [[nodiscard]] Json scene(const std::string& id, const Json& its_color, std::int64_t received_us) const {
    const Json triangles = {{"pose", pose(vector_of(Vec3::Zero()), 0.0)},
                            {"points", points},
                            {"color", its_color},
                            {"colors", Json::array()},
                            {"indices", indices}};
    return exporting::scene(received_us, id, "triangles", Json::array({triangles}));
  }
};

/// Returns a square in the plane, nearest to `from`.
Points patch_of(const Plane& plane, const Vec3& from) {
  const Vec3 centre = from - plane.signed_distance(from) * plane.n;
  const Vec3 u = plane.n.unitOrthogonal(), v = plane.n.cross(u);
  Points corners(3, 4);
  corners << centre - kPatchSide / 2 * (u + v), centre + kPatchSide / 2 * (u - v), centre + kPatchSide / 2 * (u + v),
      centre - kPatchSide / 2 * (u - v);
  return corners;
}

Json cubes_of(const Json& obstacles) {
  Json cubes = Json::array();
  for (const Json& obstacle : obstacles) {
    Json size;
    for (const char* axis : {"x", "y", "z"}) size[axis] = 2 * obstacle["half_extents"][axis].get<double>();
    cubes.push_back(
        {{"pose", pose(obstacle["position"], 0.0)},
         {"size", size},
         {"color", obstacle["moves"].get<bool>() ? color(0.88, 0.48, 0.0, 0.9) : color(0.55, 0.6, 0.65, 0.9)}});
  }
  return cubes;
}

Json line_along(const Json& control_points, double interval_s, const Json& its_color) {
  Points points(3, static_cast<Eigen::Index>(control_points.size()));
  for (Eigen::Index k = 0; k < points.cols(); ++k) {
    const Json& p = control_points[idx(k)];
    points.col(k) << p["x"].get<double>(), p["y"].get<double>(), p["z"].get<double>();
  }
  const ClampedSpline spline(points, interval_s);
  Json path = Json::array();
  const int samples = spline.intervals() * kSamplesPerInterval;
  for (int k = 0; k <= samples; ++k) {
    const Vec3 p = spline.sample(spline.duration_s() * k / samples).p;
    path.push_back(vector_of(p));
  }
  Json line{{"type", 0}, {"thickness", 3.0}, {"scale_invariant", true}, {"color", its_color}};
  line["pose"] = pose(vector_of(Vec3::Zero()), 0.0);
  line["points"] = path;
  line["colors"] = Json::array();
  line["indices"] = Json::array();
  return Json::array({line});
}

Json color_of(VoxelLabel label) {
  if (label == VoxelLabel::Attractive) return color(0.18, 0.84, 0.64, 0.25);
  if (label == VoxelLabel::Repulsive) return color(1.0, 0.3, 0.43, 0.25);
  return color(0.48, 0.56, 0.64, 0.7);
}

using LabelAndClass = std::pair<VoxelLabel, std::uint8_t>;

/// Returns all voxels of one label and class: their boxes, and above them the name of the class.
Json region(const VoxelMap& map, const LabelAndClass& of, const std::vector<Box>& boxes, std::int64_t received_us) {
  const std::string label = to_string(of.first);
  const std::string& name = map.class_names.at(of.second);
  Json entity = entity_of(received_us, name.empty() ? label : label + ": " + name);
  Box all;
  for (const Box& box : boxes) {
    all.extend(box);
    entity["cubes"].push_back({{"pose", pose(vector_of(box.center()), 0.0)},
                               {"size", vector_of(box.sizes())},
                               {"color", color_of(of.first)}});
  }
  entity["metadata"] = {{{"key", "label"}, {"value", label}}, {{"key", "class"}, {"value", name}}};
  if (!name.empty()) {
    const Vec3 above(all.center().x(), all.center().y(), all.max().z() + 0.5);
    entity["texts"] = Json::array({{{"pose", pose(vector_of(above), 0.0)},
                                    {"billboard", true},
                                    {"font_size", 14.0},
                                    {"scale_invariant", true},
                                    {"color", color(0.6, 0.6, 0.6, 1.0)},
                                    {"text", name}}});
  }
  return entity;
}

Json field_schema(const MessageField& field) {
  Json schema;
  if (message_types().contains(field.type)) {
    schema = message_schema(field.type);
  } else if (field.type == "double" || field.type == "float") {
    schema["type"] = Json::array({"number", "null"});
  } else {
    const bool text = field.digest || field.form == MessageField::Form::Text;
    schema["type"] = text ? "string" : field.type == "boolean" ? "boolean" : "integer";
  }
  if (field.form == MessageField::Form::List || field.form == MessageField::Form::FixedArray) {
    schema = {{"type", "array"}, {"items", schema}};
  }
  if (!field.comment.empty()) schema["description"] = field.comment;
  return schema;
}

Json object_schema(std::initializer_list<std::pair<const char*, Json>> fields) {
  Json schema{{"type", "object"}, {"properties", Json::object()}};
  for (const auto& [name, its_schema] : fields) schema["properties"][name] = its_schema;
  return schema;
}

Json list_schema(const Json& items) { return {{"type", "array"}, {"items", items}}; }

}  // namespace

std::optional<Drawing> drawing_of(const LoggedMessage& message) {
  const Json& m = message.fields;
  if (message.channel.starts_with(channels::kUavState.name)) {
    return Drawing{"/tern/uav",
                   "foxglove.PoseInFrame",
                   {{"timestamp", time_of(message.received_us)},
                    {"frame_id", kFrame},
                    {"pose", pose(m["motion"]["position"], m["yaw"].get<double>())}}};
  }
  if (message.type == "obstacle_truth_t") {
    return Drawing{
        "/tern/obstacles", kScene,
        scene(message.received_us, "obstacles " + m["batch"]["index"].dump(), "cubes", cubes_of(m["obstacles"]))};
  }
  if (message.type == "horizon_request_t") {
    const double interval_s = m["committed_interval_us"].get<double>() * 1e-6;
    const Json line = line_along(m["control_points"], interval_s, color(0.09, 0.2, 0.31, 1.0));
    return Drawing{"/tern/committed", kScene, scene(message.received_us, "committed", "lines", line)};
  }
  if (message.type == "plan_t" && m["outcome"].get<std::int64_t>() != kNoPlan) {
    const double interval_s = m["interval_us"].get<double>() * 1e-6;
    const Json line = line_along(m["control_points"], interval_s, color(0.25, 0.64, 0.3, 1.0));
    return Drawing{"/tern/plan", kScene, scene(message.received_us, "plan", "lines", line)};
  }
  return std::nullopt;
}

std::vector<Drawing> drawings_of(const Plan& plan, UTime t_s, const TrackSet& tracks, std::int64_t received_us) {
  if (plan.outcome == PlanOutcome::NoPlan) return {};
  Triangles hulls, planes;
  for (const PredictedHull& hull : predicted_hulls(tracks, plan.trajectory, kMaxSpan, kHullReach, kMaxHulls).hulls) {
    hulls.add(hull.points, hull_faces(hull.points));
  }
  for (const CertificatePlane& c : plan.certificate) {
    planes.add(patch_of(c.plane, place_of(c, plan.trajectory, t_s)), {{0, 1, 2}, {0, 2, 3}});
  }
  return {{"/tern/hulls", kScene, hulls.scene("hulls", color(0.56, 0.74, 0.2, 0.15), received_us)},
          {"/tern/planes", kScene, planes.scene("planes", color(0.35, 0.55, 0.95, 0.12), received_us)}};
}

Drawing drawing_of(const VoxelMap& map, std::int64_t received_us) {
  constexpr int kDeleteAll = 1;  // foxglove.SceneEntityDeletion
  const std::size_t voxels = map.labels.size();
  std::map<LabelAndClass, std::vector<bool>> regions;
  for (std::size_t k = 0; k < voxels; ++k) {
    if (map.labels[k] < VoxelLabel::Occupied) continue;
    regions.try_emplace({map.labels[k], map.classes[k]}, voxels).first->second[k] = true;
  }
  Json update;
  update["deletions"] = Json::array({{{"timestamp", time_of(received_us)}, {"type", kDeleteAll}, {"id", ""}}});
  update["entities"] = Json::array();
  for (const auto& [key, its_voxels] : regions) {
    update["entities"].push_back(region(map, key, cover_with_boxes(map.grid, its_voxels), received_us));
  }
  return {"/tern/regions", kScene, update};
}

Json foxglove_schema(const std::string& name) {
  const Json number{{"type", "number"}}, integer{{"type", "integer"}}, text{{"type", "string"}},
      flag{{"type", "boolean"}};
  const Json vector = object_schema({{"x", number}, {"y", number}, {"z", number}});
  const Json quaternion = object_schema({{"x", number}, {"y", number}, {"z", number}, {"w", number}});
  const Json its_pose = object_schema({{"position", vector}, {"orientation", quaternion}});
  const Json time = object_schema({{"sec", integer}, {"nsec", integer}});
  const Json its_color = object_schema({{"r", number}, {"g", number}, {"b", number}, {"a", number}});
  Json schema = object_schema({{"timestamp", time}, {"frame_id", text}, {"pose", its_pose}});
  if (name == kScene) {
    const Json cube = object_schema({{"pose", its_pose}, {"size", vector}, {"color", its_color}});
    const Json line = object_schema({{"type", integer},
                                     {"pose", its_pose},
                                     {"thickness", number},
                                     {"scale_invariant", flag},
                                     {"points", list_schema(vector)},
                                     {"color", its_color},
                                     {"colors", list_schema(its_color)},
                                     {"indices", list_schema(integer)}});
    const Json triangles = object_schema({{"pose", its_pose},
                                          {"points", list_schema(vector)},
                                          {"color", its_color},
                                          {"colors", list_schema(its_color)},
                                          {"indices", list_schema(integer)}});
    const Json words = object_schema({{"pose", its_pose},
                                      {"billboard", flag},
                                      {"font_size", number},
                                      {"scale_invariant", flag},
                                      {"color", its_color},
                                      {"text", text}});
    const Json entity = object_schema({{"timestamp", time},
                                       {"frame_id", text},
                                       {"id", text},
                                       {"lifetime", time},
                                       {"frame_locked", flag},
                                       {"metadata", list_schema(object_schema({{"key", text}, {"value", text}}))},
                                       {"cubes", list_schema(cube)},
                                       {"lines", list_schema(line)},
                                       {"triangles", list_schema(triangles)},
                                       {"texts", list_schema(words)}});
    const Json deletion = object_schema({{"timestamp", time}, {"type", integer}, {"id", text}});
    schema = object_schema({{"deletions", list_schema(deletion)}, {"entities", list_schema(entity)}});
  }
  schema["title"] = name;
  return schema;
}

Json message_schema(const std::string& type) {
  const MessageType& definition = message_types().at(type);
  Json schema{{"title", type}, {"description", definition.comment}, {"type", "object"}, {"properties", Json::object()}};
  for (const MessageField& field : definition.fields) schema["properties"][field.name] = field_schema(field);
  return schema;
}

}  // namespace tern::exporting
