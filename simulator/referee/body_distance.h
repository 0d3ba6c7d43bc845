// Signed distance between the vehicle's body and an axis-aligned box.
#pragma once

#include <vector>

#include "core/base/types.h"
#include "core/world/vehicle.h"

namespace tern {

/// Signed distance from the body conv(vertices) ⊕ ball(radius) to a box, m. It is the Euclidean distance where they are
/// separated, minus the shortest shift that separates them where they overlap.
///
/// As a function of the body's position it is convex and 1-Lipschitz: it is the signed distance to the Minkowski sum of
/// box and −body. The bounds of clearance.h rest on both. Spheres and boxes are closed forms (some ns). Other polytopes
/// ask core/geometry's distance. In overlap they try every possible face normal of the Minkowski sum: of the box, of
/// the body, and of an edge of each. These are O(m³) for m vertices, made once.
class BodyDistance {
 public:
  /// @throws std::invalid_argument for no vertex, a negative radius or numbers that are not finite.
  explicit BodyDistance(const Body& body);

  /// @param p_rel the body's position minus the box's centre, m; @param half_extents of the box, m, ≥ 0.
  [[nodiscard]] double operator()(const Vec3& p_rel, const Vec3& half_extents) const;

  /// The body's own bounding box about its position, m.
  [[nodiscard]] const Box& bounds() const { return bounds_; }

 private:
  [[nodiscard]] double to_polytope(const Vec3& p_rel, const Vec3& half_extents) const;

  Points vertices_;
  double radius_;
  Box bounds_;
  bool is_box_;                ///< conv(vertices) is its bounding box (a single point is one)
  Box core_;                   ///< bounding box of the vertices alone
  std::vector<Vec3> normals_;  ///< candidates, unit, one of each ±pair; empty for a box
};

}  // namespace tern
