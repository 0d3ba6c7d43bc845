// Resampling of a track to fewer pieces. The error goes into α, so a track with too many pieces for a message still
// fits.
#pragma once

#include <cstddef>

#include "core/world/track.h"

namespace tern {

/// Returns the track with at most `max_pieces` pieces. A track with no more pieces than that, and a static track, is
/// returned unchanged to the last bit.
///
/// At every time the new box contains the old one, at each level of confidence:
///
///     box(p(t), half_extents + α) ⊆ box(q(t), half_extents + α')
///
/// At a joint this holds for both pieces. It also holds before the start and after the end, since top_speed and both
/// times do not change.
///
/// Method: bottom-up segmentation (E. Keogh et al., "Segmenting time series", 2004). The two neighbouring runs of
/// pieces whose merging costs least become one cubic, until `max_pieces` runs remain.
///
/// 1. Fit: q minimizes ∫ |q − p|² dt per axis. A cubic on [a, c] is also a cubic on [a, b] and on [b, c]. So merging
///    the fits of two runs gives the fit to their original pieces. It takes 8 evaluations, since Gauss' rule with four
///    nodes is exact to degree 7.
/// 2. Cost: e(q) = max over both runs of (e(p) + max |q − p|), on the largest axis. By the triangle inequality it
///    bounds the whole error. Of equal costs the shorter run comes first, then the earlier one.
/// 3. α' per axis: the maximum over the original pieces k of a run of α_k + max |q − p_k|. It is exact, from the
///    extrema of the cubic q − p_k, plus kResamplingUlps of the largest term.
/// 4. If a message cannot hold a coefficient of the fit (message_limits.h), the fit is the least-squares constant.
///
/// O(n log n) for n pieces. @throws std::invalid_argument unless max_pieces ≥ 1 and the track has a piece
Track resampled(const Track& track, std::size_t max_pieces);

/// A bound of the rounding error of evaluating both cubics and their difference, in units of 2⁻⁵² of the sum of their
/// |terms|: three evaluations of 8 operations, doubled, and rounded up.
inline constexpr double kResamplingUlps = 64.0;

}  // namespace tern
