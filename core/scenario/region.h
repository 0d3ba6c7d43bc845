// Labelled regions of a scenario: places with a class of surface or hazard.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "core/base/types.h"

namespace tern {

/// A ball.
struct BallRegion {
  Vec3 centre = Vec3::Zero();  ///< W, m
  double radius = 1.0;         ///< m, > 0
};

/// A vertical prism over a simple polygon.
struct PrismRegion {
  std::vector<Eigen::Vector2d> corners;  ///< ≥ 3, in either sense of rotation, W, m
  double z_min = 0.0, z_max = 1.0;       ///< m, z_min < z_max
};

/// A region of one class. The mapper's configuration gives the class its label (attractive, repulsive …).
struct Region {
  std::string name;        ///< unique in a scenario
  std::string class_name;  ///< "water", "texture" …
  std::variant<Box, BallRegion, PrismRegion> shape;

  [[nodiscard]] bool contains(const Vec3& p) const;
  /// Returns the Euclidean distance from p to the region, m; 0 inside.
  [[nodiscard]] double distance(const Vec3& p) const;
  [[nodiscard]] Box bounds() const;
};

}  // namespace tern
