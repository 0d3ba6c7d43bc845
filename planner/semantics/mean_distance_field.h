// Eq. 3 as a field: the mean distance to all voxels of a kind, on a coarse grid with trilinear interpolation.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/types.h"
#include "planner/semantics/voxel_tree.h"

namespace tern {

struct MeanDistanceOptions {
  double spacing = 0.5;             ///< spacing of the grid, m; enlarged if the domain would need more than max_nodes
  std::int64_t max_nodes = 60'000;  ///< limits build time (2 to 10 µs per node) and memory (4 bytes per node)
  double node_error = 0.02;         ///< bound of the error that clusters cause at a node, m
  double far_error = 0.05;          ///< bound of the error outside the grid, where the tree is queried, m
};

/// The field f(p) = mean ‖p − v‖ over voxel centres v. It is convex and 1-Lipschitz, so trilinear interpolation is at
/// or above f. error() is the sum of two bounds:
///
///  - The error at the nodes: that of the clusters (either sign), and 1e-6 of the largest value for storage as floats.
///  - The error of the interpolation with spacing h. For one voxel at distance δ from p it is at most
///    min(√3/2·h, 3h²/(8(δ − √3h))), because f is 1-Lipschitz and |f''| ≤ 1/δ per axis. The bound averages this over
///    the worst arrangement of n voxels on their lattice: a ball about p.
///
/// With h = 0.5 m the bound is a few centimetres for a few hundred cubic metres, and 0.44 m for a single voxel.
class MeanDistanceField {
 public:
  MeanDistanceField() = default;
  /// @param domain  region of the grid, for example the map's extents, W; not empty
  MeanDistanceField(VoxelTree tree, double resolution, const Box& domain, const MeanDistanceOptions& options);

  /// Returns f(p), m: interpolated inside the domain, from the tree outside it (about 1 µs).
  [[nodiscard]] double operator()(const Vec3& p) const;
  /// Returns a bound of the error inside the domain, m.
  [[nodiscard]] double error() const { return error_; }
  [[nodiscard]] double spacing() const { return spacing_; }

 private:
  [[nodiscard]] double interpolation_error(double resolution) const;

  VoxelTree tree_;
  Box domain_;
  double spacing_ = 0.5;
  double inverse_spacing_ = 2.0;
  double far_error_ = 0.05;
  double error_ = 0.0;
  Eigen::Vector3i size_ = Eigen::Vector3i::Zero();
  std::vector<float> value_;
};

}  // namespace tern
