// The number of obstacles in the seeded world blind_corner, which its generator and readers of scenarios need.
#pragma once

namespace tern {

/// Returns the number of obstacles of a blind_corner with this many gaps per wall. They are a mover and a stub of wall
/// per gap, and the pieces of both walls.
constexpr int blind_corner_obstacles(int gaps) { return gaps == 0 ? 0 : 2 * gaps + 2 * (gaps + 1); }

}  // namespace tern
