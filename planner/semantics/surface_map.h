// The surfaces that a camera can hold on to, by labels: landmarks per m² of ground and of upright sides.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/types.h"
#include "core/world/landmark_densities.h"
#include "core/world/voxel_map.h"
#include "planner/problem/landmark_priors.h"

namespace tern {

/// A kind of surface: kOpenGround, a class of the map by its index, or kObstacles.
using SurfaceKind = std::int16_t;
inline constexpr SurfaceKind kOpenGround = 0;
inline constexpr SurfaceKind kObstacles = kMaxSurfaceClasses;

/// One upright column of space.
struct SurfaceColumn {
  float ground = 0.0f;                    ///< landmarks per m² of its ground
  float sides = 0.0f;                     ///< landmarks per m² of its upright sides; 0: it has none
  float low = 0.0f, high = 0.0f;          ///< heights between which the sides are, W, m
  bool is_opaque = false;                 ///< it hides what is behind it
  SurfaceKind ground_kind = kOpenGround;  ///< whose density its ground has
  SurfaceKind sides_kind = kOpenGround;   ///< whose density its sides have, if it has any
};

/// Columns on a horizontal grid. Outside of the grid there is open ground.
///
/// | in the column                            | ground          | sides                       |
/// |------------------------------------------|-----------------|-----------------------------|
/// | a voxel of a class denser than the ground | of that class  | of that class; hide nothing |
/// | a voxel of another class                 | of that class   | none                        |
/// | an occupied voxel, or an obstacle at rest | unchanged      | `obstacles`; hide           |
class SurfaceMap {
 public:
  static constexpr double kColumn = 0.5;      ///< least side of a column, m
  static constexpr double kMaxColumns = 5e5;  ///< the side is enlarged so that there are at most as many

  SurfaceMap() = default;
  /// The columns of a map. O(voxels).
  SurfaceMap(const VoxelMap& map, const LandmarkPriors& priors);
  /// Returns this map with other densities of the same kinds. Only surfaces that the labels gave sides have them.
  /// O(columns).
  [[nodiscard]] SurfaceMap with_densities(const SurfaceDensities& densities) const;
  /// Returns this map with these boxes as opaque obstacles. O(columns).
  [[nodiscard]] SurfaceMap with_obstacles(const std::vector<Box>& boxes) const;

  [[nodiscard]] const SurfaceColumn& at(double x, double y) const;
  /// Returns a number that differs between columns, −1 outside of the grid.
  [[nodiscard]] int column_of(double x, double y) const;
  /// The box about all columns that differ from open ground, W; empty if none does.
  [[nodiscard]] const Box& extent() const { return extent_; }
  [[nodiscard]] double ground_z() const { return ground_z_; }
  /// The densities that the labels promise.
  [[nodiscard]] const SurfaceDensities& promised() const { return promised_; }

 private:
  void lay_grid(const Box& bounds);
  void put_obstacle(const Box& box);

  SurfaceColumn open_;
  SurfaceDensities promised_;
  double obstacles_ = 0.0, ground_z_ = 0.0;
  Box extent_;
  double x0_ = 0.0, y0_ = 0.0, step_ = kColumn;
  int nx_ = 0, ny_ = 0;
  std::vector<SurfaceColumn> columns_;
};

}  // namespace tern
