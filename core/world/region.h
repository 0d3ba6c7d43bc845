// Labelled regions: where a class of surface or hazard lies, as a scenario draws it.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "core/base/types.h"

namespace tern {

struct BallRegion {
  Vec3 centre = Vec3::Zero();  ///< W, m
  double radius = 1.0;         ///< m, > 0
};

/// A simple polygon in the horizontal plane, with a height interval.
struct PrismRegion {
  std::vector<Eigen::Vector2d> corners;  ///< ≥ 3, either turning sense, W, m
  double z_min = 0.0, z_max = 1.0;       ///< m, z_min < z_max
};

/// A region of one class. Which label the class has (attractive, repulsive …) is the mapper's configuration.
struct Region {
  std::string name;        ///< unique in a scenario
  std::string class_name;  ///< "water", "texture" …
  std::variant<Box, BallRegion, PrismRegion> shape;

  [[nodiscard]] bool contains(const Vec3& p) const;
  /// Euclidean distance from p to the region, m; 0 inside.
  [[nodiscard]] double distance(const Vec3& p) const;
  [[nodiscard]] Box bounds() const;
};

}  // namespace tern
