// A body and what surrounds it.
#pragma once

#include "core/world/vehicle.h"

namespace tern {

/// The body ⊕ the box [−margin, margin]: what it covers when its position is off by up to `margin` per axis.
///
/// Exact. Vertices v become v ± margin; of a body that is a box (or a ball) only the corners of the grown box are kept.
/// @param margin  m, ≥ 0 per axis; zero leaves the body as it is, to the last bit
Body grown(const Body& body, const Vec3& margin);

/// The smallest box that holds the body, about its position, m.
Box body_box(const Body& body);

/// The positions at which a body of this box meets `box`.
Box places_at(const Box& box, const Box& body);

/// The positions at which it lies within `room`; empty if it is larger.
Box places_within(const Box& room, const Box& body);

}  // namespace tern
