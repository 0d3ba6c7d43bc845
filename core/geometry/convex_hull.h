// Convex hulls with exact predicates (CGAL), behind our own types. The only CGAL in Tern.
#pragma once

#include "core/base/types.h"

namespace tern {

/// The extreme points of conv(points), in W.
///
/// @param points  3×n, n ≥ 1, finite. Duplicates, collinear, coplanar and single points are all allowed.
/// @return 3×m, a subset of the input columns with conv(result) = conv(points), no column superfluous. They are sorted
///   by (x, y, z), so that the order of the input does not matter.
/// @throws std::invalid_argument if n = 0 or a coordinate is not finite.
/// Predicates are exact (CGAL's Epick kernel), so no input is "nearly degenerate". About 30 µs for the
/// 40 corners of a box swept in 5 samples, 55 µs for 64 corners.
Points hull_vertices(const Points& points);

}  // namespace tern
