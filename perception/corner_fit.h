// The visible corner of an axis-aligned box, fitted to the depths of a cluster.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "perception/depth_picture.h"

namespace tern {

/// A ray is on a face if its depth differs from the face's by at most kFitSigmas · σ + kFitMargin. Stereo errors and
/// small bumps of real surfaces are the margin.
inline constexpr float kFitSigmas = 3.0F;
inline constexpr float kFitMargin = 0.05F;  ///< m
/// Added to the σ of a depth, so that weights stay finite and rounding is no evidence, m.
inline constexpr float kLeastSigma = 0.003F;

/// Faces that meet in a corner, up to one per axis, relative to the sensor, axes of W.
struct Corner {
  std::array<int, 3> side{};     ///< −1: the face at the box's minimum is seen, +1: at its maximum, 0: none
  std::array<float, 3> plane{};  ///< the face's coordinate, m
  std::array<float, 3> sigma{};  ///< its standard deviation for white noise, m
  std::array<int, 3> rays{};     ///< how many rays are on the face
  std::array<bool, 3> weak{};    ///< the face is one pixel wide, has few rays, or they graze it
  int fitting = 0;               ///< rays on a face

  [[nodiscard]] int faces() const { return (side[0] != 0 ? 1 : 0) + (side[1] != 0 ? 1 : 0) + (side[2] != 0 ? 1 : 0); }
};

/// The rays of one cluster, side by side in memory.
class ClusterRays {
 public:
  static constexpr std::int8_t kNoFace = -1;

  void gather(const DepthPicture& picture, std::span<const int> pixels);

  [[nodiscard]] int count() const { return static_cast<int>(depth.size()); }
  /// The depth at which ray k meets a corner, and the axis of the face there; 0 and kNoFace if it meets none.
  [[nodiscard]] std::pair<float, std::int8_t> meet(const Corner& corner, int k) const;

  std::vector<int> pixel;
  std::array<std::vector<float>, 3> ray, inverse;  ///< components in W, scaled to depth 1, and 1/component
  std::vector<float> depth, sigma;                 ///< m
  std::vector<float> fitted;                       ///< depth of the corner, m
  std::vector<std::int8_t> face;                   ///< axis of the face; kNoFace: the ray does not fit
};

/// Fits a corner to a cluster, and sets `fitted` and `face` of its rays.
///
/// Pixel i has the depth z_i and the ray d_i. A box shows its face across axis a if the sensor lies outside the 10–90 %
/// range of the points' coordinates along a. A ray enters a box through the last of its front planes. The depth of a
/// corner p (relative to the sensor) along ray i is therefore
///
///     z_i(p) = max over the shown faces a of p_a / d_ia
///
/// 1. p starts at the nearer quantile of each shown axis.
/// 2. Every ray is assigned to the face at which z_i(p) is attained. Rays farther than 2σ + 2 cm from it are left out.
///    Towards the sensor this gate is wider at first, by 0.25 m, and narrows: if one surface lies behind another, the
///    nearer one is fitted.
/// 3. p_a becomes the mean of z_i d_ia over the rays of face a, weighted by 1/(σ_i d_ia)². Steps 2 and 3 are repeated.
/// 4. A face is dropped if its rays fit the other faces nearly as well. Otherwise the end of a beam that the picture
///    cuts off would pass for a face. Steps 2 and 3 are repeated without it.
/// 5. If less than 90 % of the rays fit, the cluster may be several objects. The fit then starts anew with the nearest
///    parts of the cluster, and the fit with the most rays is returned.
///
/// A face is weak if it has fewer than max(12, 4 %) rays, is one pixel wide, or if its rays graze it.
class CornerFitter {
 public:
  Corner fit(const DepthPicture& picture, ClusterRays& rays);

 private:
  /// Starts with the quantiles of all rays up to a depth.
  [[nodiscard]] Corner start(const ClusterRays& rays, float most_depth);
  [[nodiscard]] Corner fit_from(Corner corner, ClusterRays& rays, int block);
  [[nodiscard]] float depth_quantile(const ClusterRays& rays, double share);

  std::vector<float> sorted_;
};

}  // namespace tern
