// Oracle: whether two convex hulls are disjoint, in exact integer arithmetic.
#pragma once

#include "core/base/types.h"
#include "core/geometry/plane.h"

namespace tern {

/// If coordinates are multiples of this (m) and the sets lie within 16 m of each other, 128 bits suffice (about 5 µs).
/// Otherwise 2048 bits are used (about a millisecond).
inline constexpr double kExactGrid = 0x1.0p-24;

/// The relation of conv(a) and conv(b).
struct ExactSeparation {
  bool disjoint = false;  ///< exact: the closed hulls have no common point
  double distance = 0.0;  ///< m, the exact distance rounded (to about 1e-15 of itself); 0 if not disjoint
};

/// Decides by a descent to the point of conv(a) − conv(b) nearest to the origin, and proves the answer. The proof is a
/// vector with a positive product with every a − b, or positive integer weights with which some a − b sum to zero.
/// @throws std::invalid_argument if a set is empty, a coordinate is not finite, or coordinates span more than 2¹⁵⁰
///   of their last bit
ExactSeparation exact_separation(const Points& a, const Points& b);

/// True if n·a + d ≥ 0 for every a and n·b + d ≤ −margin for every b, in exact arithmetic.
bool exactly_separates(const Plane& plane, const Points& a, const Points& b, double margin);

}  // namespace tern
