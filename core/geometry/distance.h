// The distance between two convex hulls, with a lower and an upper bound. Method: Gilbert, Johnson and Keerthi, "A
// fast procedure for computing the distance between complex objects in three-dimensional space", 1988.
#pragma once

#include "core/base/types.h"

namespace tern {

/// The shortest vector from conv(b) to conv(a), with bounds of its length.
struct ShortestVector {
  Vec3 v = Vec3::Zero();  ///< from a point of conv(b) to a point of conv(a), m; zero if the hulls overlap.
  /// Distance ≥ lower, m: the width of the empty slab across v between the hulls. Negative if v does not separate
  /// them.
  double lower = 0.0;
  double upper = 0.0;  ///< distance ≤ upper, m: the distance between two points of the hulls
};

/// Returns the shortest vector from conv(b) to conv(a).
///
/// Each step finds the point of conv(a) − conv(b) that is lowest along v, and adds it to a simplex of at most 4 such
/// points. The point of the simplex nearest to the origin is the new v. The descent ends in one of three cases: the
/// bounds agree to 1e-12 of the distance; upper ≤ enough; rounding prevents progress. It usually takes 5 steps of O(n
/// + m) and allocates nothing. Both bounds have a rounding error of about 1e-15 of the largest coordinate.
/// @param a, b    3×n and 3×m points in W, n, m ≥ 1, finite. They need not be vertices of their hulls; duplicates
///   and flat sets are allowed.
/// @param enough  m, ≥ 0: the descent may end once the distance is known to be at most this
ShortestVector shortest_vector(const Points& a, const Points& b, double enough);

/// Returns the distance between conv(a) and conv(b), m; 0 if they touch or overlap.
/// @pre as for shortest_vector()
double distance(const Points& a, const Points& b);

}  // namespace tern
