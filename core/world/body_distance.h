// Signed distance between the vehicle's body and an axis-aligned box.
#pragma once

#include <vector>

#include "core/base/types.h"
#include "core/world/vehicle.h"

namespace tern {

/// Signed distance from the body conv(vertices) ⊕ ball(radius) to a box, m. It is the Euclidean distance if they are
/// separated, otherwise minus the shortest shift that separates them.
///
/// As a function of the body's position it is the signed distance to the Minkowski sum of box and −body. So it is
/// convex and 1-Lipschitz; the bounds of clearance.h use both.
///
/// | body                            | method                                                                     |
/// |---------------------------------|----------------------------------------------------------------------------|
/// | ball or box, also rounded       | closed form, some ns                                                       |
/// | other polytope, separated       | core/geometry/distance.h                                                   |
/// | other polytope, overlapping     | the smallest shift along any normal that a face of the sum can have        |
///
/// The constructor computes these normals, O(m³) for m vertices. Each is normal to one of these:
/// - a face of the box,
/// - a plane through three vertices,
/// - an edge of the box and a line through two vertices.
class BodyDistance {
 public:
  /// @throws std::invalid_argument for an empty list of vertices, a negative radius, or a number that is not finite.
  explicit BodyDistance(const Body& body);

  /// Returns the signed distance, m. @param p_rel  the body's position minus the box's centre, m
  /// @param half_extents  of the box, m, ≥ 0
  [[nodiscard]] double operator()(const Vec3& p_rel, const Vec3& half_extents) const;

  /// The body's bounding box about its position, m.
  [[nodiscard]] const Box& bounds() const { return bounds_; }

 private:
  [[nodiscard]] double to_polytope(const Vec3& p_rel, const Vec3& half_extents) const;

  Points vertices_;
  double radius_;
  Box bounds_;
  bool is_box_;                ///< conv(vertices) equals its bounding box (a single point does)
  Box core_;                   ///< bounding box of the vertices, without the radius
  std::vector<Vec3> normals_;  ///< candidates, unit, one of each ± pair; empty for a box
};

}  // namespace tern
