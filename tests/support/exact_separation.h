// The oracle of separation: whether two convex hulls are disjoint, in exact integer arithmetic.
#pragma once

#include "core/base/types.h"
#include "core/geometry/plane.h"

namespace tern {

/// Metres. If coordinates are multiples of this and the sets lie within 16 m of each other, 128 bits decide (about 5
/// µs). Else 2048 bits do (about a millisecond).
inline constexpr double kExactGrid = 0x1.0p-24;

/// What is true of conv(a) and conv(b).
struct ExactSeparation {
  bool disjoint = false;  ///< exact: the closed hulls have no common point
  double distance = 0.0;  ///< m, the exact distance rounded (to about 1e-15 of itself); 0 if not disjoint
};

/// Decides by descent to the point of conv(a) − conv(b) nearest to the origin, and proves its answer. The proof is a
/// vector with positive product with every a − b, or positive integer weights with which some a − b sum to zero.
/// @throws std::invalid_argument for empty sets, not finite coordinates, or such that span more than 2¹⁵⁰ of their last
/// bit.
ExactSeparation exact_separation(const Points& a, const Points& b);

/// Whether n·a + d ≥ 0 for every a and n·b + d ≤ −margin for every b, without rounding.
bool exactly_separates(const Plane& plane, const Points& a, const Points& b, double margin);

}  // namespace tern
