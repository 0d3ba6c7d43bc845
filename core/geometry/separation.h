// Fast separation of two convex hulls: the distance between them, and the plane of widest margin.
#pragma once

#include <optional>

#include "core/base/types.h"
#include "core/geometry/plane.h"

namespace tern {

/// Within this distance of touching, "not separated" is always a right answer; beyond it the answer is exact. Metres.
/// Derived from double rounding of coordinates up to 1e4 m (1e4 · 2⁻⁵² · some dozens of operations), rounded up.
inline constexpr double kTouchingTolerance = 1e-6;
/// A published plane holds the vehicle's points at n·q + d ≤ −kPlaneMargin. Metres.
inline constexpr double kPlaneMargin = 1e-9;

/// A plane and the gap that it proves.
struct Separation {
  Plane plane;       ///< n·x + d ≥ 0 on A's points, ≤ −kPlaneMargin (and ≤ −clearance) on B's
  double gap = 0.0;  ///< width of the slab between A and B that the plane's normal proves, m; at most the distance
};

/// The plane of widest margin between conv(a) and conv(b), if they are separated by more than `clearance` +
/// kTouchingTolerance.
///
/// @param a  obstacle's points, 3×n, n ≥ 1; @param b  vehicle's points, 3×m, m ≥ 1.
/// @param clearance  m, ≥ 0: the radius of a spherical vehicle (0: a point or the shape is already in the hull).
/// @return nullopt if not separated, or in doubt even after GLPK has been asked; for coordinates within 1e4 m doubt
///   arises within kTouchingTolerance only. Else the plane touches A (min n·a + d = 0 up to rounding, never below) and
///   has every b at n·b + d ≤ −max(clearance, kPlaneMargin). Both hold in exact arithmetic and as
///   Plane::signed_distance computes them. Both are verified against all points.
/// @throws std::invalid_argument for an empty set, a negative clearance, or a coordinate that is not finite. (The last
///   may also end in "not separated", never in a plane.)
/// O(n + m), about 0.3 µs for 30 + 4 points; no heap.
/// Always computed anew from (a, b): no caller state, so that a replay gives the same bits.
std::optional<Separation> separate(const Points& a, const Points& b, double clearance);

/// Counters of a thread, for PLAN_TIMING: how often the linear programme was asked.
struct SeparationCounts {
  long fast = 0;  ///< settled by the distance algorithm
  long lp = 0;    ///< handed to the linear programme
};
/// The calling thread's own, to read and to reset. Never part of a result.
SeparationCounts& separation_counts();

}  // namespace tern
