// Is a set of points separated from a swept box? Asked of the sweep itself, without its convex hull.
#pragma once

#include <optional>
#include <span>

#include "core/base/types.h"
#include "core/geometry/separation.h"

namespace tern {

/// box_around(centre, half), W, m.
struct CentredBox {
  Vec3 centre = Vec3::Zero();
  Vec3 half = Vec3::Zero();  ///< ≥ 0
};

/// What is_separated() can say.
enum class IsSeparated {
  Yes,   ///< separated by more than clearance + kTouchingTolerance, proven along a direction
  No,    ///< nearer than that
  Doubt  ///< rounding ended the descent before either was proven: ask separate()
};

/// Are the convex hull A of all boxes and B = conv(points) ⊕ conv(vertices) separated by more than clearance +
/// kTouchingTolerance?
///
/// The same question as separate(hull_vertices(corners of the boxes), points ⊕ vertices, clearance) answers, and the
/// same answer but for rounding within kTouchingTolerance of touching. It needs no hull, because the support point of a
/// box is a sign per axis: min n·a = min over boxes of n·centre − |n|·half. And it ends as soon as either answer is
/// proven: Gilbert, Johnson and Keerthi's descent gives a lower bound of the distance, v·w/|v|, with every step.
///
/// @param boxes      ≥ 1, finite
/// @param points     3×m, m ≥ 1, column-major, finite
/// @param vertices   of the vehicle, added to the points; empty: none
/// @param clearance  m, ≥ 0
/// @param direction  in: where to begin, from B to A, any length but 0. One that separated a similar pair before often
///   proves the answer at once; it is always verified on all boxes and points. Out, after Yes: one that proves it.
/// About 20 ns when the direction does, 0.1 µs otherwise; no heap.
IsSeparated is_separated(std::span<const CentredBox> boxes, const Eigen::Ref<const Points>& points,
                         const Points& vertices, double clearance, Vec3& direction);

/// The plane of widest margin without the hull, but for rounding the one of separate() of the hull's vertices. It has
/// n·x + d ≥ 0 on all boxes ⊕ (−vertices), ≤ −max(clearance, kPlaneMargin) on all points, verified on every one.
/// @return nullopt if they are not separated by more than clearance + kTouchingTolerance, or in doubt. Arguments of
/// is_separated(). About 0.2 µs.
std::optional<Separation> separate_sweep(std::span<const CentredBox> boxes, const Eigen::Ref<const Points>& points,
                                         const Points& vertices, double clearance);

}  // namespace tern
