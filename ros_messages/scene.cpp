#include "ros_messages/scene.h"

#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "core/drawing/hull_faces.h"
#include "core/drawing/plane_place.h"
#include "core/drawing/predicted_hulls.h"
#include "core/world/box_cover.h"
#include "core/world/names.h"

namespace tern::ros {
namespace {

constexpr double kHullReach = 3.0;  // m
constexpr int kMaxHulls = 60;
constexpr double kPatchSide = 1.0;  // m
constexpr std::uint8_t kDeleteAll = 1;
constexpr Color kMovingColor{0.88, 0.48, 0.0, 0.9}, kStaticColor{0.55, 0.6, 0.65, 0.9};
constexpr Color kHullColor{0.56, 0.74, 0.2, 0.15}, kPlaneColor{0.35, 0.55, 0.95, 0.12};
constexpr Color kTextColor{0.6, 0.6, 0.6, 1.0};

double rounded(double x) {
  constexpr double kPerMetre = 512.0;
  return std::round(x * kPerMetre) / kPerMetre;
}
Point point(const Vec3& p) { return {rounded(p.x()), rounded(p.y()), rounded(p.z())}; }
Vector3 vector(const Vec3& v) { return {rounded(v.x()), rounded(v.y()), rounded(v.z())}; }

void add_triangles(TriangleListPrimitive& to, const Points& corners, const std::vector<std::array<int, 3>>& faces) {
  const auto first = static_cast<std::uint32_t>(to.points.size());
  for (Eigen::Index k = 0; k < corners.cols(); ++k) to.points.push_back(point(corners.col(k)));
  for (const auto& face : faces) {
    for (const int corner : face) to.indices.push_back(first + static_cast<std::uint32_t>(corner));
  }
}

/// Returns a square in the plane, nearest to `from`.
Points patch_of(const Plane& plane, const Vec3& from) {
  const Vec3 centre = from - plane.signed_distance(from) * plane.n;
  const Vec3 u = plane.n.unitOrthogonal(), v = plane.n.cross(u);
  Points corners(3, 4);
  corners << centre - kPatchSide / 2 * (u + v), centre + kPatchSide / 2 * (u - v), centre + kPatchSide / 2 * (u + v),
      centre - kPatchSide / 2 * (u - v);
  return corners;
}

CubePrimitive cube(const Vec3& centre, const Vec3& size, const Color& color) {
  return {{point(centre), {}}, vector(size), color};
}

Color color_of(VoxelLabel label) {
  if (label == VoxelLabel::Attractive) return {0.18, 0.84, 0.64, 0.25};
  if (label == VoxelLabel::Repulsive) return {1.0, 0.3, 0.43, 0.25};
  return {0.48, 0.56, 0.64, 0.7};
}

using LabelAndClass = std::pair<VoxelLabel, std::uint8_t>;

/// Fills an entity with all voxels of one label and class: their boxes, and above them the name of the class.
void add_region(SceneEntity& entity, VoxelLabel label, const std::string& class_name, const std::vector<Box>& boxes) {
  Box all;
  for (const Box& box : boxes) {
    all.extend(box);
    entity.cubes.push_back(cube(box.center(), box.sizes(), color_of(label)));
  }
  entity.metadata = {{"label", to_string(label)}, {"class", class_name}};
  if (class_name.empty()) return;
  const Vec3 above(all.center().x(), all.center().y(), all.max().z() + 0.5);
  entity.texts.push_back({{point(above), {}}, true, 14.0, true, kTextColor, class_name});
}

}  // namespace

SceneEntity SceneDrawing::entity(const std::string& id) const {
  SceneEntity entity;
  entity.timestamp = to_ros(at_);
  entity.frame_id = frames_.world;
  entity.id = id;
  return entity;
}

SceneUpdate SceneDrawing::scene(SceneEntity entity) const { return {{}, {std::move(entity)}}; }

SceneUpdate SceneDrawing::obstacles(const ObstacleTruth& complete_set) const {
  SceneEntity obstacles = entity("obstacles");
  for (const TrueObstacle& obstacle : complete_set.obstacles) {
    obstacles.cubes.push_back(
        cube(obstacle.position, 2.0 * obstacle.half_extents, obstacle.moves ? kMovingColor : kStaticColor));
  }
  return scene(std::move(obstacles));
}

SceneUpdate SceneDrawing::line(const TimedSpline& trajectory, const std::string& id, const Color& color) const {
  const ClampedSpline spline = trajectory.spline();
  LinePrimitive line;
  line.thickness = 3.0;
  line.scale_invariant = true;
  line.color = color;
  const int samples = spline.intervals() * kSamplesPerInterval;
  for (int k = 0; k <= samples; ++k) {
    line.points.push_back(point(spline.sample(spline.duration_s() * k / samples).p));
  }
  SceneEntity with_line = entity(id);
  with_line.lines.push_back(std::move(line));
  return scene(std::move(with_line));
}

SceneUpdate SceneDrawing::hulls(const Plan& plan, const TrackSet& tracks) const {
  TriangleListPrimitive triangles;
  triangles.color = kHullColor;
  for (const PredictedHull& hull : predicted_hulls(tracks, plan.trajectory, kMaxSpan, kHullReach, kMaxHulls).hulls) {
    add_triangles(triangles, hull.points, hull_faces(hull.points));
  }
  SceneEntity hulls = entity("hulls");
  hulls.triangles.push_back(std::move(triangles));
  return scene(std::move(hulls));
}

SceneUpdate SceneDrawing::planes(const Plan& plan, UTime t_s) const {
  TriangleListPrimitive triangles;
  triangles.color = kPlaneColor;
  for (const CertificatePlane& c : plan.certificate) {
    add_triangles(triangles, patch_of(c.plane, place_of(c, plan.trajectory, t_s)), {{0, 1, 2}, {0, 2, 3}});
  }
  SceneEntity planes = entity("planes");
  planes.triangles.push_back(std::move(triangles));
  return scene(std::move(planes));
}

SceneUpdate SceneDrawing::regions(const VoxelMap& map) const {
  const std::size_t voxels = map.labels.size();
  std::map<LabelAndClass, std::vector<bool>> regions;
  for (std::size_t k = 0; k < voxels; ++k) {
    if (map.labels[k] < VoxelLabel::Occupied) continue;
    regions.try_emplace({map.labels[k], map.classes[k]}, voxels).first->second[k] = true;
  }
  SceneUpdate update;
  update.deletions.push_back({to_ros(at_), kDeleteAll, ""});
  for (const auto& [key, its_voxels] : regions) {
    std::string id = to_string(key.first);
    const std::string& name = map.class_names.at(key.second);
    if (!name.empty()) id.append(": ").append(name);
    SceneEntity& region = update.entities.emplace_back(entity(id));
    add_region(region, key.first, name, cover_with_boxes(map.grid, its_voxels));
  }
  return update;
}

}  // namespace tern::ros
