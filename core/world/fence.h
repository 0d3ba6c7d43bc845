// Geofences: where a vehicle must stay, and where it must not go.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <string>
#include <variant>
#include <vector>

namespace tern {

/// A vertical prism over a simple polygon, or over a circle.
struct FencePolygon {
  std::vector<Eigen::Vector2d> corners;  ///< ≥ 3, in either sense of rotation
};
struct FenceCircle {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  double radius = 1.0;  ///< m, > 0
};

/// A geofence. The vehicle's body must stay inside at least one inclusion fence, if there is one, and outside all
/// exclusion fences.
struct Fence {
  std::string name;  ///< may be empty
  bool is_inclusion = true;
  std::variant<FencePolygon, FenceCircle> shape;
  double floor = -std::numeric_limits<double>::infinity();   ///< W, m
  double ceiling = std::numeric_limits<double>::infinity();  ///< W, m, > floor
  bool is_geodetic = false;  ///< corners and centre are (latitude, longitude) in degrees; else (x, y) in W, m
};

/// A file with fences: a plan of QGroundControl or GeoJSON.
struct FenceFile {
  std::string file;                                          ///< absolute, or relative to the scenario's folder
  double floor = -std::numeric_limits<double>::infinity();   ///< of fences that state none, W, m
  double ceiling = std::numeric_limits<double>::infinity();  ///< the same
};

}  // namespace tern
