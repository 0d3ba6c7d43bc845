// The semantic costs of a map's attractive and repulsive voxels, prepared once per map version.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/base/types.h"
#include "core/world/voxel_map.h"
#include "planner/semantics/mean_distance_field.h"
#include "planner/semantics/voxel_kind.h"

namespace tern {

struct SemanticFieldsOptions {
  double exposure_margin = 1.0;    ///< exposure decreases to 0 within this distance of a region, m, > 0
  double lambda_attractive = 1.0;  ///< λ_att ≥ 0
  double lambda_repulsive = 1.0;   ///< λ_rep ≥ 0
  std::vector<std::pair<std::string, double>> class_lambdas;  ///< class name and its own λ ≥ 0
  MeanDistanceOptions mean_distance;
};

/// The distance from p to the nearest voxel of a kind, in the band where exposure varies.
///
/// It is the exact Euclidean distance transform between voxel centres, minus half a voxel, with trilinear
/// interpolation. Along the normal of a flat face that follows the grid it is exact. Elsewhere it differs from the
/// distance to the union of the cubes by at most kBandError voxels. Of these √3/2 are by interpolation of a 1-Lipschitz
/// function, and (√3−1)/2 because a cube is no ball.
class DistanceBand {
 public:
  static constexpr double kBandError = 1.233;

  DistanceBand() = default;
  DistanceBand(const VoxelMap& map, const VoxelKind& kind, double margin);

  /// Returns the distance, clamped to [0, margin], m; 0 inside the region.
  [[nodiscard]] double operator()(const Vec3& p) const;
  /// Outside this box the distance is `margin`.
  [[nodiscard]] const Box& window() const { return window_; }

 private:
  double margin_ = 1.0;
  double inverse_step_ = 1.0;
  Box window_;  ///< box of the sampled voxel centres
  Eigen::Vector3i size_ = Eigen::Vector3i::Zero();
  std::vector<float> distance_;
};

/// The mean distance of Eq. 3 and our exposure, for the labels Attractive and Repulsive, with one λ per class.
///
///  - Exposure e_c(p) is 1 inside class c and decreases linearly to 0 at the margin outside. The repulsive cost per
///    metre is max_c λ_c e_c(p). The attractive cost is λ* − max_c λ_c e_c(p), with λ* = max_c λ_c. So costs are
///    never negative, and overlapping regions of one class cost as much as one.
///  - Mean distance: C = (1/|M|) Σ_{v ∈ M} w_v ‖p − v‖ over all voxel centres of the label, where w_v is the λ of
///    v's class. For equal λ this is λ C of Eq. 3.
///
/// Fields are immutable. Queries are without allocation and use only sqrt of libm, so that a replay computes the same
/// bytes. A query takes at most 50 ns per distinct λ inside the grids. Building takes about 0.5 s for 10⁶ labelled
/// voxels; memory is 4 bytes per voxel of the labels' bounding boxes.
class SemanticFields {
 public:
  SemanticFields() = default;
  /// For a map without attractive or repulsive voxels the fields are empty and cheap, and has() is false.
  explicit SemanticFields(const VoxelMap& map, const SemanticFieldsOptions& options = {});

  [[nodiscard]] std::uint64_t map_version() const { return version_; }
  /// Returns whether there are voxels of this label: Attractive or Repulsive.
  [[nodiscard]] bool has(VoxelLabel label) const;
  /// Returns whether any voxel has a positive λ.
  [[nodiscard]] bool has_weight() const;

  /// Outside this box the exposure cost per metre is λ*, the strongest attraction. The box is empty if no λ is
  /// positive.
  [[nodiscard]] const Box& influence() const { return influence_; }
  /// Returns whether the exposure cost per metre varies within the box.
  [[nodiscard]] bool varies_in(const Box& box) const;

  /// Returns the exposure cost of the label per metre at p, ≥ 0.
  [[nodiscard]] double exposure_cost(VoxelLabel label, const Vec3& p) const;
  /// Returns ∫ exposure_cost ds along the segment ab, m, by the midpoint rule with samples at most half the margin
  /// apart.
  [[nodiscard]] double exposure_cost(VoxelLabel label, const Vec3& a, const Vec3& b) const;
  /// The same for both labels together.
  [[nodiscard]] double exposure_cost(const Vec3& a, const Vec3& b) const;

  /// Returns Σ_c λ_c C_c(p), m, ≥ 0; 0 without such voxels. Inside the map's extents the error is at most Σ_c λ_c times
  /// error() of the fields (MeanDistanceField), weighed by the classes' shares. Outside them it is at most λ_c
  /// far_error.
  [[nodiscard]] double mean_distance_cost(VoxelLabel label, const Vec3& p) const;
  /// Returns attraction minus repulsion, λ_att C_att − λ_rep C_rep of Eq. 2, m.
  [[nodiscard]] double mean_distance_cost(const Vec3& p) const;

  [[nodiscard]] double exposure_margin() const { return margin_; }

 private:
  /// All voxels of one label whose classes have one λ.
  struct Group {
    VoxelLabel label;
    double lambda;
    double share;  ///< share of the label's voxels
    DistanceBand band;
    MeanDistanceField mean;
  };
  void prepare(const VoxelMap& map, VoxelLabel label, const SemanticFieldsOptions& options);
  template <class Rate>
  [[nodiscard]] double integral(const Vec3& a, const Vec3& b, double outside, const Rate& rate) const;

  std::uint64_t version_ = 0;
  double margin_ = 1.0;
  double strongest_attraction_ = 0.0;
  Box influence_;
  std::vector<Group> groups_;
};

}  // namespace tern
