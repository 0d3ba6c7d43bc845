// A body and what surrounds it.
#pragma once

#include "core/world/vehicle.h"

namespace tern {

/// The body ⊕ the box [−margin, margin]: what it covers when its position is off by up to `margin` per axis.
///
/// Exact. Vertices v become v ± margin; of a body that is a box (or a ball) only the corners of the grown box are kept.
/// @param margin  m, ≥ 0 per axis; zero leaves the body as it is, to the last bit
Body grown(const Body& body, const Vec3& margin);

}  // namespace tern
