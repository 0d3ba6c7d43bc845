// What the planner asks of a map's attractive and repulsive voxels, prepared once per map version.
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
  double exposure_margin = 1.0;                               ///< m, > 0: how far outside a region exposure ramps
  double lambda_attractive = 1.0;                             ///< λ_att ≥ 0
  double lambda_repulsive = 1.0;                              ///< λ_rep ≥ 0
  std::vector<std::pair<std::string, double>> class_lambdas;  ///< class name → λ of its own, ≥ 0
  MeanDistanceOptions mean_distance;
};

/// How far p is from the nearest voxel of a label, in the band where exposure varies.
///
/// The exact Euclidean distance transform between voxel centres, less half a voxel, interpolated trilinearly. It is
/// exact along the normal of a flat face that follows the grid. The true distance to the union of the label's cubes
/// differs by at most kBandError voxels. That is √3/2 by interpolation of a 1-Lipschitz function and (√3−1)/2 because a
/// cube is no ball.
class DistanceBand {
 public:
  static constexpr double kBandError = 1.233;

  DistanceBand() = default;
  DistanceBand(const VoxelMap& map, const VoxelKind& kind, double margin);

  /// 0 inside the region, `margin` and more are margin: clamped to [0, margin], m.
  [[nodiscard]] double operator()(const Vec3& p) const;
  /// Beyond this box the answer is `margin`.
  [[nodiscard]] const Box& window() const { return window_; }

 private:
  double margin_ = 1.0;
  double inverse_step_ = 1.0;
  Box window_;  ///< of the sampled voxel centres
  Eigen::Vector3i size_ = Eigen::Vector3i::Zero();
  std::vector<float> distance_;
};

/// Eq. 3's mean distance and our exposure for the labels Attractive and Repulsive, each class with its λ. Immutable,
/// queries allocate nothing and use no libm but sqrt, so that a replay computes the same bytes. At most 50 ns a query
/// and distinct λ inside the fields' grids. Building: about 0.5 s for 10⁶ labelled voxels; memory 4 bytes per voxel of
/// the labels' bounding boxes.
///
/// Exposure with several classes: e_c = 1 inside a class c, falling linearly to 0 at the margin outside. What repels
/// most counts, max_c λ_c e_c(p). So does what is missed of the strongest attraction: λ* − max_c λ_c e_c(p), λ* = max_c
/// λ_c. So a metre costs the same in one region as where two of a class overlap, and nothing is ever a reward. Mean
/// distance: C = (1/|M|) Σ_{v ∈ M} w_v ‖p − v‖ over all voxel centres of the label, w_v the λ of v's class. Where the λ
/// are equal, that is λ C of Eq. 3.
class SemanticFields {
 public:
  SemanticFields() = default;
  /// A map without attractive or repulsive voxels gives cheap fields that answer as `has` = false.
  explicit SemanticFields(const VoxelMap& map, const SemanticFieldsOptions& options = {});

  [[nodiscard]] std::uint64_t map_version() const { return version_; }
  /// Are there voxels of this label? Only Attractive and Repulsive are ever prepared.
  [[nodiscard]] bool has(VoxelLabel label) const;
  /// Are there voxels whose λ is positive?
  [[nodiscard]] bool weighs() const { return !influence_.isEmpty(); }

  /// Outside this box a metre's exposure cost is λ*, the strongest attraction. Empty when nothing weighs.
  [[nodiscard]] const Box& influence() const { return influence_; }
  /// Does the exposure cost differ anywhere in the box?
  [[nodiscard]] bool varies_in(const Box& box) const;

  /// What regions of the label cost per metre at p, ≥ 0.
  [[nodiscard]] double exposure_cost(VoxelLabel label, const Vec3& p) const;
  /// ∫ exposure_cost ds along the segment ab, m: midpoint rule with samples at most half the margin apart.
  [[nodiscard]] double exposure_cost(VoxelLabel label, const Vec3& a, const Vec3& b) const;
  /// Of both labels.
  [[nodiscard]] double exposure_cost(const Vec3& a, const Vec3& b) const;

  /// Σ_c λ_c C_c(p), m, ≥ 0; 0 without such voxels. Inside the map's extents it errs by at most Σ_c λ_c error() of
  /// the fields (MeanDistanceField) by the classes' shares of the voxels, beyond them by λ_c far_error.
  [[nodiscard]] double mean_distance_cost(VoxelLabel label, const Vec3& p) const;
  /// Attraction less repulsion: λ_att C_att − λ_rep C_rep of Eq. 2.
  [[nodiscard]] double mean_distance_cost(const Vec3& p) const;

  [[nodiscard]] double exposure_margin() const { return margin_; }

 private:
  /// All voxels of one label whose classes have one λ.
  struct Group {
    VoxelLabel label;
    double lambda;
    double share;  ///< of the label's voxels
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
