// Regions around a vehicle's body.
#pragma once

#include "core/world/vehicle.h"

namespace tern {

/// Returns body ⊕ [−margin, margin]: the region that the body covers if its position is wrong by up to `margin` per
/// axis.
///
/// The result is exact. Every vertex v becomes the corners v ± margin. For a box (or a ball) only the corners of the
/// enlarged box are kept.
/// @param margin  m, ≥ 0 per axis; zero returns the body unchanged to the last bit
Body grown(const Body& body, const Vec3& margin);

/// Returns the smallest box that contains the body, relative to its position, m.
Box body_box(const Body& body);

/// Returns the box of all positions at which a body with this bounding box meets `box`.
Box places_at(const Box& box, const Box& body);

/// Returns the box of all positions at which a body with this bounding box lies within `room`. It is empty if the body
/// is larger than the room.
Box places_within(const Box& room, const Box& body);

}  // namespace tern
