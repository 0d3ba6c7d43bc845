// The sweep of a predicted obstacle over a time span: boxes along its motion, whose convex hull contains it (paper
// §3.2, docs/planner/separation.md).
#pragma once

#include <vector>

#include "core/geometry/swept_boxes.h"
#include "core/world/alpha_share.h"
#include "core/world/track.h"

namespace tern {

/// The largest β, m: how far the hull may exceed the true sweep because the motion is sampled.
inline constexpr double kBetaMax = 0.005;

/// Appends boxes whose convex hull contains the track's box, with a share of its α, during [from, to] seconds after
/// `origin`.
///
/// Within a cubic piece |ξ''| ≤ a per axis, so the chord between samples h apart is at most β = a h²/8 off the curve.
/// The boxes are enlarged by β. There is a sample at every joint, and h is small enough for β ≤ kBetaMax. At most 256
/// samples per piece are used, so very large accelerations give a larger β. Outside the pieces the box grows at
/// top_speed.
/// @param body_half  half-extents of the body, added to those of the boxes, m, ≥ 0
void add_sweep(std::vector<CentredBox>& out, const Track& track, const AlphaShare& share, const Vec3& body_half,
               UTime origin, double from, double to);

}  // namespace tern
