#include "core/world/body.h"

#include "core/geometry/box.h"

namespace tern {
namespace {

/// True if the vertices are exactly the corners of their bounding box.
bool is_box(const Points& vertices, const Box& bounds) {
  const Eigen::Matrix<double, 3, 8> corners = box_corners(bounds);
  const auto among = [](const Vec3& p, const auto& points) {
    return (points.colwise() - p).colwise().squaredNorm().minCoeff() == 0.0;
  };
  for (int k = 0; k < 8; ++k) {
    if (!among(corners.col(k), vertices)) return false;
  }
  for (Eigen::Index k = 0; k < vertices.cols(); ++k) {
    if (!among(vertices.col(k), corners)) return false;
  }
  return true;
}

}  // namespace

Vec3 Body::half_extents() const { return vertices.cwiseAbs().rowwise().maxCoeff().array() + radius; }

Box body_box(const Body& body) {
  return {body.vertices.rowwise().minCoeff().array() - body.radius,
          body.vertices.rowwise().maxCoeff().array() + body.radius};
}

Box places_at(const Box& box, const Box& body) { return {box.min() - body.max(), box.max() - body.min()}; }

Box places_within(const Box& room, const Box& body) { return {room.min() - body.min(), room.max() - body.max()}; }

Body grown(const Body& body, const Vec3& margin) {
  if (margin.isZero(0.0)) return body;
  const Points& v = body.vertices;
  const Box bounds(v.rowwise().minCoeff(), v.rowwise().maxCoeff());
  if (is_box(v, bounds)) return {box_corners(Box(bounds.min() - margin, bounds.max() + margin)), body.radius};
  const Eigen::Matrix<double, 3, 8> around = box_corners(Box(-margin, margin));
  Body result{Points(3, 8 * v.cols()), body.radius};
  for (Eigen::Index k = 0; k < v.cols(); ++k) {
    result.vertices.middleCols<8>(8 * k) = around.colwise() + Vec3(v.col(k));
  }
  return result;
}

}  // namespace tern
