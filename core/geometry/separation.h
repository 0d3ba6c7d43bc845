// Fast separation of two convex hulls by the plane with the largest margin. Its use: docs/planner/separation.md.
#pragma once

#include <optional>

#include "core/base/types.h"
#include "core/geometry/plane.h"

namespace tern {

/// Tolerance of separate(), m. If the distance of two hulls differs from the clearance by at most this, they may be
/// reported as not separated. All other answers are exact. It bounds the rounding of coordinates up to 1e4 m: 1e4 ·
/// 2⁻⁵² times some dozens of operations.
inline constexpr double kTouchingTolerance = 1e-6;
/// Every published plane has n·q + d ≤ −kPlaneMargin on the vehicle's points q. m.
inline constexpr double kPlaneMargin = 1e-9;

/// A separating plane and the gap that its normal proves.
struct Separation {
  Plane plane;       ///< n·x + d ≥ 0 on A's points, n·x + d ≤ −max(clearance, kPlaneMargin) on B's
  double gap = 0.0;  ///< width of the slab across n between A and B, m; at most their distance
};

/// Returns the plane with the largest margin between conv(a) and conv(b) if their distance exceeds clearance +
/// kTouchingTolerance.
///
/// The plane touches A: min n·a + d = 0 up to rounding, and never below 0. Every b has n·b + d ≤ −max(clearance,
/// kPlaneMargin). Both claims hold in exact arithmetic and as Plane::signed_distance() computes them; both are
/// verified on all points. The result depends on the arguments only, so a replay gives the same bits. O(n + m), about
/// 0.3 µs for 30 + 4 points; no heap.
/// @param a  the obstacle's points, 3×n, n ≥ 1
/// @param b  the vehicle's points, 3×m, m ≥ 1
/// @param clearance  m, ≥ 0: the radius of a spherical vehicle; 0 for a point, or if the body is already in the hull
/// @return nullopt if the hulls are not separated, or if the question is in doubt even after GLPK was asked. For
///   coordinates within 1e4 m doubt arises within kTouchingTolerance only.
/// @throws std::invalid_argument if a set is empty, the clearance is negative, or a coordinate is not finite. For
///   the last, nullopt is also possible; a plane is never returned.
std::optional<Separation> separate(const Points& a, const Points& b, double clearance);

/// Counters of one thread for PLAN_TIMING: how separate() settled its questions.
struct SeparationCounts {
  long fast = 0;  ///< by the distance algorithm
  long lp = 0;    ///< by the linear program
};
/// Returns the calling thread's counters, to read and to reset. They never influence a result.
SeparationCounts& separation_counts();

}  // namespace tern
