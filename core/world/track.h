// The messages DECLARED_MOTIONS and PREDICTIONS: tracks, the motions of obstacles with their error bounds.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/base/types.h"
#include "core/splines/piecewise_cubic.h"
#include "core/wire/header.h"
#include "core/world/pose_error.h"

namespace tern {

/// The origin of a track's motion.
enum class TrackKind : std::uint8_t {
  Static = 0,     ///< it never moves: one piece, valid at all times
  Declared = 1,   ///< its owner declares the motion
  Estimated = 2,  ///< a model estimates the motion; it holds with TrackSet::confidence
};

/// The levels of confidence for which a prediction states α, in descending order. If a set has another confidence
/// (TrackSet::confidence), it replaces the first level, and higher levels become equal to it.
inline constexpr std::array<double, 5> kConfidenceLevels = {0.99, 0.95, 0.9, 0.8, 0.6};
inline constexpr int kLevels = static_cast<int>(kConfidenceLevels.size());

/// Returns the confidence of a level, 0 … kLevels − 1, in a set with confidence `set_confidence`. If that is 1, it is
/// 1 at all levels.
inline double confidence_at(double set_confidence, int level) {
  const bool is_of_set = level == 0 || set_confidence >= 1.0;
  return is_of_set ? set_confidence : std::min(set_confidence, kConfidenceLevels[idx(level)]);
}

/// The shares of one piece: α at level k ≥ 1, on an axis of W, is shares[k − 1][axis] times α. Each lies in (0, 1].
/// They do not increase with k.
using AlphaShares = std::array<std::array<float, 3>, kConfidenceLevels.size() - 1>;
/// Returns shares that are the same on all axes.
inline AlphaShares on_all_axes(const std::array<float, kConfidenceLevels.size() - 1>& of_levels) {
  AlphaShares shares;
  for (std::size_t k = 0; k < shares.size(); ++k) shares[k].fill(of_levels[k]);
  return shares;
}
/// Returns the share that `part` is of `alpha` on one axis, rounded up to the next float. @pre 0 ≤ part ≤ alpha
inline float share_of(double part, double alpha) {
  const double share = part > 0.0 ? part / alpha : 0.0;
  return std::nextafter(std::max(static_cast<float>(share), std::numeric_limits<float>::min()), 2.0F);
}

/// One obstacle over time: an axis-aligned box, which contains all rotations of its shape, moves along cubic pieces.
/// At each time t of piece k the true box lies within box_around(p(t), half_extents + alpha[k]), with the set's
/// confidence.
struct Track {
  std::int64_t id = 0;
  TrackKind kind = TrackKind::Declared;
  Vec3 half_extents = Vec3::Zero();  ///< m, each ≥ 0
  PiecewiseCubic motion;             ///< centre, W
  std::vector<Vec3> alpha;           ///< α per piece, half-extents of the error box, m, each ≥ 0
  std::vector<AlphaShares> shares;   ///< per piece; empty: α is the same at all levels (Static, Declared)
  double top_speed = 0.0;  ///< m/s per axis, ≥ 0: before the first and after the last piece the box grows at this speed

  /// Returns α of a piece at a level, 0 … kLevels − 1, m.
  [[nodiscard]] Vec3 alpha_at(std::size_t piece, int level) const {
    Vec3 at = alpha[piece];
    if (level == 0 || shares.empty()) return at;
    for (int axis = 0; axis < 3; ++axis) at[axis] *= static_cast<double>(shares[piece][idx(level - 1)][idx(axis)]);
    return at;
  }

  /// Returns a box that contains box and α at all times in [t0, t1]; the times may lie outside the pieces.
  [[nodiscard]] Box bounds(UTime t0, UTime t1) const;
};

/// DECLARED_MOTIONS, PREDICTIONS: a complete set of tracks, or one batch of it.
struct TrackSet {
  Header header;
  BatchHeader batch;
  UTime made_at;              ///< time of the newest input; the set is stale 0.3 s later
  double confidence = 1.0;    ///< (0, 1]: probability that a track stays within its α over all pieces; 1 if declared
  std::int32_t left_out = 0;  ///< tracks that did not fit into the batches, the farthest ones
  std::vector<Track> tracks;  ///< a complete set is in ascending order of ids.
  /// The POSE_ERROR of a complete set. Nullopt if the vehicle's pose is taken as exact.
  std::optional<PoseError> pose_error;
};

}  // namespace tern
