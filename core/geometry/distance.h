// The distance between two convex hulls (Gilbert, Johnson, Keerthi 1988), with bounds from both sides.
#pragma once

#include "core/base/types.h"

namespace tern {

/// The shortest vector from conv(b) to conv(a), as far as it is known.
struct ShortestVector {
  Vec3 v = Vec3::Zero();  ///< from a point of conv(b) to a point of conv(a), m; zero when the hulls overlap
  double lower =
      0.0;  ///< m; the slab across v that holds no point of either: distance ≥ lower, negative when v proves nothing
  double upper = 0.0;  ///< m; the distance of two known points of the hulls: distance ≤ upper
};

/// Narrows lower and upper until they agree to 1e-12 of the distance, upper falls to `enough`, or rounding stops the
/// descent.
///
/// @param a, b    3×n and 3×m points in W, n, m ≥ 1, finite. Need not be extreme; repeated and flat sets are allowed.
/// @param enough  m, ≥ 0: a caller who only asks "farther apart than this?" saves the rest of the descent.
/// Each step takes the support point of conv(a) − conv(b) against v. Then it takes the point of the simplex (at most 4
/// such points) nearest to the origin. Pure; no heap. Both bounds are up to rounding, about 1e-15 of the greatest
/// coordinate. Some 5 steps of O(n + m).
ShortestVector shortest_vector(const Points& a, const Points& b, double enough);

/// Distance between conv(a) and conv(b), m: 0 where they touch or overlap. Preconditions of shortest_vector.
double distance(const Points& a, const Points& b);

}  // namespace tern
