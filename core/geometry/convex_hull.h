// Convex hulls with exact predicates. CGAL is used here only; this header hides it behind Tern's own types.
#pragma once

#include "core/base/types.h"

namespace tern {

/// Returns the vertices of conv(points), in W.
///
/// Predicates are exact (CGAL's Epick kernel), so rounding does not affect which points are vertices. The call takes
/// about 30 µs for the 40 corners of a box swept in 5 samples, and 55 µs for 64 corners.
/// @param points  3×n, n ≥ 1, finite. Duplicates, collinear, coplanar and single points are allowed.
/// @return 3×m: the smallest subset of the input columns with conv(result) = conv(points). It is sorted by (x, y,
///   z), so the result does not depend on the order of the input.
/// @throws std::invalid_argument if n = 0 or a coordinate is not finite
Points hull_vertices(const Points& points);

}  // namespace tern
