// Where a predicted obstacle is during a time span: boxes along its motion, whose convex hull holds it (paper §3.2).
#pragma once

#include <vector>

#include "core/geometry/swept_boxes.h"
#include "core/world/alpha_share.h"
#include "core/world/track.h"

namespace tern {

/// β ≤ this, m: how far a hull may exceed the true sweep because motion is sampled.
inline constexpr double kBetaMax = 0.005;

/// Appends boxes whose convex hull holds the track's box, with what counts of its α, over [from, to] seconds after
/// origin.
///
/// β: within a cubic piece |ξ''| ≤ a per axis. So the chord between samples h apart leaves the curve by at most a h²/8,
/// by which the boxes are grown. Samples stand at every piece break, and h keeps β ≤ kBetaMax. Only what is accelerated
/// so much that 256 samples of a piece do not suffice has a larger one. Outside the pieces: a box that grows at top
/// speed.
/// @param body_half  added to all half-extents, m, ≥ 0
void add_sweep(std::vector<CentredBox>& out, const Track& track, const AlphaShare& share, const Vec3& body_half,
               UTime origin, double from, double to);

}  // namespace tern
