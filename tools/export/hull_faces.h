// The faces of a convex hull, as triangles to draw.
#pragma once

#include <array>
#include <vector>

#include "core/base/types.h"

namespace tern::exporting {

/// Triangles that cover the surface of conv(vertices): columns of it, counter-clockwise seen from outside. None when
/// the points lie in a plane. For drawing: points within 1e-6 of the hull's size of a plane lie in it.
/// @param vertices  3×m: extreme points (core/geometry/convex_hull.h). O(m⁴), about 20 µs for the 16 of a swept box
std::vector<std::array<int, 3>> hull_faces(const Points& vertices);

}  // namespace tern::exporting
