// A track with fewer pieces, its error in α: a motion too finely cut for a message is made coarser, never dropped.
#pragma once

#include <cstddef>

#include "core/world/track.h"

namespace tern {

/// The track with at most `most` pieces; itself, bit for bit, if it has no more (or is Static).
///
/// At every time t in [start, end] the new box contains the old one,
///   box(p(t), half_extents + α) ⊆ box(q(t), half_extents + α').
/// At a joint that holds for both pieces that meet there. It holds beyond the ends, too, since top_speed and both times
/// are the old ones.
///
/// Method: neighbouring runs of pieces become one cubic, those first whose merging costs least, until `most` remain
/// (E. Keogh et al., "Segmenting time series", 2004: bottom-up).
///   Fit: the cubic of least ∫ |q − p|² dt per axis. Each cubic of [a, c] is a cubic of [a, b] and of [b, c]. So
///     projection onto the cubics of [a, c] needs p only as its projections on both halves. Merging two fits thus gives
///     the fit to the original: 8 evaluations (Gauss' rule with four nodes is exact to degree 7).
///   Order: by e(q) = max over both halves of (e(p) + max |q − p|), largest axis. By the triangle inequality this
///     bounds the whole error, in constant time. Ties: the shorter run, then the earlier.
///   α': per axis and exactly, max over the original pieces k of a run of α_k + max over k's time of |q − p_k|. It
///     comes from the extrema of the cubic q − p_k, plus kResamplingUlps of the largest term.
/// At each level of confidence the same holds, α and α' at that level (Track::shares).
/// A fit whose coefficients a message could not hold (message_limits.h) is replaced by the constant of least squares.
///
/// Pure; O(n log n) for n pieces. @throws std::invalid_argument unless most ≥ 1 and the track has a piece.
Track resampled(const Track& track, std::size_t most);

/// Rounding of evaluating both cubics and their difference, in units of 2⁻⁵² of the sum of their |terms|: 8 rounded
/// operations each, thrice, doubled.
inline constexpr double kResamplingUlps = 64.0;

}  // namespace tern
