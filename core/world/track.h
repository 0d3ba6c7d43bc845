// Tracks: what is believed or promised of obstacles' motion. One type serves DECLARED_MOTIONS and PREDICTIONS.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/types.h"
#include "core/splines/piecewise_cubic.h"
#include "core/world/header.h"

namespace tern {

enum class TrackKind : std::uint8_t {
  Static = 0,     ///< never moves: one piece, valid for ever
  Declared = 1,   ///< its owner promises the motion
  Estimated = 2,  ///< a model's belief, kept with TrackSet::confidence
};

/// The levels of confidence at which a prediction states its α, falling. The first one is what is promised; where a set
/// promises another confidence (TrackSet::confidence), that stands in its place and no level lies above it.
inline constexpr std::array<double, 5> kConfidenceLevels = {0.99, 0.95, 0.9, 0.8, 0.6};
inline constexpr int kLevels = static_cast<int>(kConfidenceLevels.size());

/// The confidence of a level, 0 … kLevels − 1, in a set that promises `promised`; of what is certain (1) it is 1 at
/// all.
inline double confidence_at(double promised, int level) {
  const bool is_promise = level == 0 || promised >= 1.0;
  return is_promise ? promised : std::min(promised, kConfidenceLevels[idx(level)]);
}

/// Of one piece: α at level k ≥ 1 is shares[k − 1] times α, the same on all axes. Each in (0, 1], not rising with k.
using AlphaShares = std::array<float, kConfidenceLevels.size() - 1>;

/// One obstacle: an axis-aligned box (it contains the shape's rotations) that moves along piecewise cubics.
/// The promise: at each time t of piece k the true box lies within box_around(p(t), half_extents + alpha[k]).
struct Track {
  std::int64_t id = 0;
  TrackKind kind = TrackKind::Declared;
  Vec3 half_extents = Vec3::Zero();  ///< m, each ≥ 0
  PiecewiseCubic motion;             ///< centre, W
  std::vector<Vec3> alpha;           ///< per piece: half-extents of the error box, m, each ≥ 0; size = pieces
  std::vector<AlphaShares> shares;  ///< per piece what α is at lower levels; empty: the same at all (Static, Declared)
  double top_speed = 0.0;           ///< m/s per axis, ≥ 0: beyond the last piece the box grows at this speed

  /// The part of α[piece] that counts at a level, 0 … kLevels − 1: (0, 1].
  [[nodiscard]] double share_at(std::size_t piece, int level) const {
    if (level == 0 || shares.empty()) return 1.0;
    return static_cast<double>(shares[piece][idx(level - 1)]);
  }

  /// A box that surely holds the obstacle during [t0, t1] (any times; before the start the first piece's rule applies
  /// backwards).
  [[nodiscard]] Box bounds(UTime t0, UTime t1) const;
};

/// A complete set of tracks, or one batch of it.
struct TrackSet {
  Header header;
  BatchHeader batch;
  UTime made_at;              ///< the newest input that it rests on, s: stale when older than 0.3 s
  double confidence = 1.0;    ///< in (0, 1]: probability that a track keeps its α over its pieces (1: declared)
  std::int32_t left_out = 0;  ///< tracks that did not fit in the batches, farthest first
  std::vector<Track> tracks;  ///< by id ascending in a complete set
};

}  // namespace tern
