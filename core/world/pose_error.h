// The message POSE_ERROR: how wrong the place of a thing known in W may be, for a vehicle that estimates its own pose.
#pragma once

#include <array>
#include <cstdint>

#include "core/base/types.h"
#include "core/wire/header.h"

namespace tern {

/// POSE_ERROR: the error of the vehicle's pose, for one set of PREDICTIONS. A predictor that receives ODOMETRY sends it
/// before each of its sets.
///
/// A vehicle flies relative to W as it believes W to be. Let its position p̂ have the error e, and its attitude the
/// error θ. Then a thing known in W at x is off by e + θ × (x − p̂):
///
///     Σ(x) = J Σ_pose Jᵀ,   J = [1, −[x − p̂]×],   margin(x) = k √λ_max(Σ(x)) + apart,   k = 3.368
///
/// k is the 99 % quantile of the length of a normal vector in three dimensions over the standard deviation of each
/// axis. Margins are rounded up to kStep, so that static obstacles change seldom.
struct PoseError {
  static constexpr double kQuantile = 3.368;   ///< √χ²(3, 0.99)
  static constexpr double kConfidence = 0.99;  ///< of the margin
  static constexpr double kStep = 0.05;        ///< m

  Header header;
  std::int64_t set = 1;                      ///< of PREDICTIONS, by the same sender, ≥ 1
  Vec3 position = Vec3::Zero();              ///< p̂, W, m
  std::array<double, 36> pose_covariance{};  ///< of position (W, m) and rotation (W, rad), row by row
  double apart = 0.0;  ///< added to each margin: a correction under way, a stale estimate, m, ≥ 0

  /// Returns the margin at x (W, m), per axis.
  [[nodiscard]] double margin(const Vec3& x) const;
  /// Returns the largest margin in a box that is not empty. It is at a corner, since margin() is convex.
  [[nodiscard]] double margin(const Box& box) const;
};

}  // namespace tern
