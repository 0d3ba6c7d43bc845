#include "core/world/body_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/geometry/box.h"
#include "core/geometry/distance.h"

namespace tern {
namespace {

/// Shortest cross product of edges that is used as a direction, m².
constexpr double kNoDirection = 1e-12;

/// Distance from the origin to the box of centre c and half-extents h.
double signed_distance_to_box(const Vec3& c, const Vec3& h) {
  const Vec3 beyond = c.cwiseAbs() - h;
  return beyond.maxCoeff() > 0.0 ? beyond.cwiseMax(0.0).norm() : beyond.maxCoeff();
}

bool has_all_corners(const Points& vertices, const Box& box) {
  const Points corners = box_corners(box);
  for (int i = 0; i < 8; ++i) {
    if ((vertices.colwise() - corners.col(i)).colwise().squaredNorm().minCoeff() > 0.0) return false;
  }
  return true;
}

std::vector<Vec3> face_normals(const Points& v) {
  std::vector<Vec3> normals = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  const auto add = [&](const Vec3& n) {
    if (n.norm() > kNoDirection) normals.push_back(n.normalized());
  };
  for (Eigen::Index i = 0; i < v.cols(); ++i) {
    for (Eigen::Index j = i + 1; j < v.cols(); ++j) {
      const Vec3 edge = v.col(j) - v.col(i);
      for (int axis = 0; axis < 3; ++axis) add(Vec3::Unit(axis).cross(edge));
      for (Eigen::Index k = j + 1; k < v.cols(); ++k) add(edge.cross(v.col(k) - v.col(i)));
    }
  }
  return normals;
}

}  // namespace

BodyDistance::BodyDistance(const Body& body) : vertices_(body.vertices), radius_(body.radius) {
  if (vertices_.cols() < 1 || !vertices_.allFinite())
    throw std::invalid_argument("body: there is no vertex, or a coordinate is not finite");
  if (!(radius_ >= 0.0) || !std::isfinite(radius_)) throw std::invalid_argument("body: radius negative or not finite");
  core_ = Box(vertices_.rowwise().minCoeff(), vertices_.rowwise().maxCoeff());
  bounds_ = grown(core_, Vec3::Constant(radius_));
  is_box_ = has_all_corners(vertices_, core_);
  if (!is_box_) normals_ = face_normals(vertices_);
}

double BodyDistance::operator()(const Vec3& p_rel, const Vec3& half_extents) const {
  if (is_box_) {
    const Vec3 half = 0.5 * core_.sizes();
    return signed_distance_to_box(p_rel + core_.center(), half_extents + half) - radius_;
  }
  return to_polytope(p_rel, half_extents) - radius_;
}

double BodyDistance::to_polytope(const Vec3& p_rel, const Vec3& half_extents) const {
  const Points box = box_corners(Box(-half_extents, half_extents));
  const Points body = vertices_.colwise() + p_rel;
  const double apart = distance(box, body);
  if (apart > 0.0) return apart;
  double shift = std::numeric_limits<double>::infinity();
  for (const Vec3& n : normals_) {
    const Eigen::RowVectorXd along = n.transpose() * body;
    const double reach = half_extents.dot(n.cwiseAbs());
    shift = std::min({shift, reach - along.minCoeff(), reach + along.maxCoeff()});
  }
  return -std::max(shift, 0.0);
}

}  // namespace tern
