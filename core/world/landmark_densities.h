// The message LANDMARK_DENSITIES: the densities of landmarks by which a planner prices the error of ways.
#pragma once

#include <cstdint>
#include <vector>

#include "core/wire/header.h"

namespace tern {

/// Landmarks per m² of each kind of surface.
struct SurfaceDensities {
  double obstacles = 0.0;        ///< of obstacles at rest
  std::vector<double> by_class;  ///< [0]: of open ground; [c]: of the map's class c, its ground and its upright sides
  friend bool operator==(const SurfaceDensities&, const SurfaceDensities&) = default;
};

/// LANDMARK_DENSITIES: the densities of a goal field, where they are not those of the labels. A planner sends it before
/// the first plan that reads the field. Such plans name it by `statics`.
struct LandmarkDensities {
  Header header;
  std::uint64_t statics = 0;      ///< GoalFieldInputs::statics of those plans: name_of() the rest
  std::uint64_t tracks = 0;       ///< digest of the static tracks' boxes
  std::uint64_t map_version = 0;  ///< of the map that has the classes
  SurfaceDensities densities;
};
inline constexpr double kMaxLandmarkDensity = 50.0;  ///< 1/m²
inline constexpr std::int32_t kMaxSurfaceClasses = 256;

/// Returns the digest of `tracks`, `map_version` and the densities.
std::uint64_t name_of(const LandmarkDensities& densities);

}  // namespace tern
