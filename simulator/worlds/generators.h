// The seeded worlds of the paper, of MADER and of SANDO: pure functions of (generator, seed, count, start, goal).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/scenario/scenario.h"

namespace tern {

/// Least distance of a generated obstacle from the start during kStartQuiet, m.
inline constexpr double kStartClearance = 1.0;
/// Time from world time 0, s.
inline constexpr double kStartQuiet = 1.0;
/// Least distance of a static obstacle from start and goal, m. A mover must be farther than this from the goal at some
/// time of its period.
inline constexpr double kEndClearance = 0.5;

struct GeneratedObstacles {
  std::vector<ObstacleSpec> obstacles;  ///< movers first, then pillars, then the rest
  int redrawn = 0;                      ///< draws that the rules about start and goal refused
};

/// Draws `count` obstacles with Rng(seed), one after the other, each in the order x, y, z, scales, s, φ. Fixed values
/// are not drawn. M = ⌊0.65 N⌋ of them move; ⌊0.35 (N − M)⌋ are pillars. A wave's φ is drawn like a trefoil's.
///
///  - paper_corridor, paper_attract, paper_repel, corridor_demo: x∈[2,72], y∈[−2,2], z∈[0,4]. Movers: cubes of 0.8 m
///    on trefoils k = 1, s = 1.1, φ∈[−2π,2π]. The rest is static, 0.4×0.4×8 m at z = 2 (z is not drawn).
///  - mader_corridor: x∈[2,75], y∈[−3,3], z∈[1,2], movers as above. The rest at x∈[1,76], y∈[−4,4] moves z − sin(t+φ):
///    pillars 0.4×0.4×4 at z = 2, beams 0.4×8×0.4 at z∈[0,3].
///  - sando_forest: x∈[5,100], y∈[−6,6], z∈[0.5,4.5]. Movers: cubes of 0.8 m on trefoils s∈[4,6], φ∈[0,3],
///    k = (U(2,4)/6, U(2,4)/5, U(2,4)/2). Static pillars are 0.4×0.4×4 at z = 2. Of the beams (0.4×0.4 m thick, 4 m
///    long) the first half, rounded down, lies along y, the others along x.
///  - step_aside: what core/scenario/step_aside.h draws for (seed, start). Count and goal do not matter; nothing is
///    refused.
///  - blind_corner: a corridor with `count` gaps (blind_corner.h). Nothing is refused.
///
/// A draw is refused, and repeated from the present state of the stream, if
///  - the obstacle's box comes within kStartClearance of the start in the first kStartQuiet (sampled every 10 ms), or
///  - it is static and within kEndClearance of start or goal, or
///  - it moves and is within kEndClearance of the goal at all of 256 instants of its period.
///
/// @param slowness  of all trefoils, in place of the drawn one
/// @return an Error for an unknown generator, a count outside 0 … 100000, or 1000 refused draws in a row.
Result<GeneratedObstacles> generate(const std::string& generator, int count, std::uint64_t seed, const Vec3& start,
                                    const Vec3& goal, std::optional<double> slowness = {});

}  // namespace tern
