// Triangulates the surface of a convex hull, for drawing.
#pragma once

#include <array>
#include <vector>

#include "core/base/types.h"

namespace tern {

/// Returns triangles that cover the surface of conv(vertices): column indices, counter-clockwise seen from outside.
/// Empty if the points lie in a plane. A point counts as in a plane if its distance from the plane is at most 1e-6 of
/// the hull's size. Cost O(m⁴), about 20 µs for the 16 vertices of a swept box.
/// @param vertices  3×m: extreme points (core/geometry/convex_hull.h)
std::vector<std::array<int, 3>> hull_faces(const Points& vertices);

}  // namespace tern
