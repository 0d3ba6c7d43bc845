// The seeded world blind_corner: a corridor with gaps in its walls, out of which somebody steps.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/result.h"
#include "core/scenario/scenario.h"

namespace tern {

/// Draws a straight corridor along W's x, from 3 m behind the start to 3 m before the goal, with Rng(seed).
///
/// - Its half width d is drawn from [1, 3) m, about the start's y. The walls are 0.2 m thick and 3 m high.
/// - Both walls have the same `gaps` gaps of 1.5 m. Each gap has a drawn place in its share of the corridor.
/// - Behind one wall, drawn per gap, an upright box of 0.5 × 0.5 × 3 m waits before the gap, as seen from the start. It
///   cannot be seen from any place of the corridor before the gap. The wall hides it, and a stub of wall behind it
///   hides it from the gaps before.
/// - At a drawn time it walks to the gap, then across the corridor into the opposite gap, where it stays. Its speed is
///   drawn from [0.5, 2) m/s. In the corridor's middle it meets a vehicle that flies 2.5 to 5 m/s on average. It sets
///   out at 0.5 s at the earliest.
///
/// The draws are d, then per gap: place, side, speed, time.
///
/// @return movers first, then stubs, then the pieces of the walls: blind_corner_obstacles(gaps) of them. An Error if
/// the goal is not far enough along x: each gap needs 6 m
Result<std::vector<ObstacleSpec>> draw_blind_corner(int gaps, std::uint64_t seed, const Vec3& start, const Vec3& goal);

}  // namespace tern
