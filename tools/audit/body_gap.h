// The distance between the vehicle's body and a box, from support functions alone.
#pragma once

#include "core/world/vehicle.h"

namespace tern::audit {

/// Bounds of a signed distance, m; negative in overlap.
struct Gap {
  double low = 0.0, high = 0.0;
};

/// Bounds the distance between the body at `p` and the box of half-extents h about the origin.
///
/// - Sphere: exact. In overlap it is minus the depth along the nearest axis.
/// - Other bodies: the point of least norm of body − box (P. Wolfe, *Finding the nearest point in a polytope*, 1976).
///   Each step's support value proves a lower bound; the point itself is an upper bound. The two agree within 1e-6 m,
///   or as closely as 200 steps bring them. In overlap both are −1e-6 minus the body's radius; no depth is computed.
Gap body_gap(const Body& body, const Vec3& p, const Vec3& h);

/// Returns the smallest box that holds the body at every position in `positions`.
Box swept_box(const Body& body, const Box& positions);

}  // namespace tern::audit
