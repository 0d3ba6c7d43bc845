// How far the vehicle's body is from a box, by support functions alone.
#pragma once

#include "core/world/vehicle.h"

namespace tern::audit {

/// Bounds of the signed distance, m: negative where they overlap.
struct Gap {
  double low = 0.0, high = 0.0;
};

/// The distance from the body to the box of half-extents h about the origin, the body's position being `p`.
///
/// A sphere: exact, negative in overlap (the depth along the nearest axis). Another body: the point of least norm of
/// body − box (P. Wolfe, *Finding the nearest point in a polytope*, 1976). Every step's support value proves a lower
/// bound, the point itself an upper one. They agree within 1e-6 m, or as far as 200 steps come. In overlap both are
/// −1e-6 (and the radius less): the depth is not asked for.
Gap body_gap(const Body& body, const Vec3& p, const Vec3& h);

/// The smallest box that holds the body at all of these positions.
Box swept_box(const Body& body, const Box& positions);

}  // namespace tern::audit
