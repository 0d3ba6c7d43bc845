// Eq. 3 as a field: the mean distance to all voxels of a label on a coarse grid, interpolated trilinearly.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/types.h"
#include "planner/semantics/voxel_tree.h"

namespace tern {

struct MeanDistanceOptions {
  double spacing = 0.5;             ///< of the grid, m; enlarged where the domain needs more than max_nodes
  std::int64_t max_nodes = 60'000;  ///< bounds build time (about 2–10 µs a node) and memory (4 bytes a node)
  double node_error = 0.02;         ///< bound of the clusters' error at a node, m
  double far_error = 0.05;          ///< bound of the answer outside the grid, where the tree is asked directly, m
};

/// f(p) = mean ‖p − v‖ is convex and 1-Lipschitz. So the trilinear interpolation lies above f by at most error(). This
/// is a sum of two:
///  * The clusters' error at the nodes (either sign) and 1e-6 of the largest value for storage in floats.
///  * The interpolation's, for one voxel at distance δ from p at most min(√3/2·h, 3h²/(8(δ − √3h))) with h the spacing
///    (1-Lipschitz; |f''| ≤ 1/δ per axis). It is averaged over the worst arrangement of n voxels on their lattice, a
///    ball about p. For a few hundred cubic metres at h = 0.5 m it is a few centimetres; for a single voxel, 0.44 m.
class MeanDistanceField {
 public:
  MeanDistanceField() = default;
  /// @param domain  where the grid is laid (the map's extents, say); not empty
  MeanDistanceField(VoxelTree tree, double resolution, const Box& domain, const MeanDistanceOptions& options);

  /// f(p), m: interpolated inside the domain, by the tree (about 1 µs) outside.
  [[nodiscard]] double operator()(const Vec3& p) const;
  /// Bound of |answer − f(p)| inside the domain, m.
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
