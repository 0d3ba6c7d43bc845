// The seeded worlds of the paper, of MADER and of SANDO: pure functions of (generator, seed, count, start, goal).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/world/scenario.h"

namespace tern {

/// No obstacle of a generator comes this near to the start, m …
inline constexpr double kStartClearance = 1.0;
/// … within this first time, s.
inline constexpr double kStartQuiet = 1.0;
/// No static obstacle stands this near to start or goal, and no mover stays this near to the goal all its period, m.
inline constexpr double kEndClearance = 0.5;

struct GeneratedObstacles {
  std::vector<ObstacleSpec> obstacles;  ///< movers first, then pillars, then the rest
  int redrawn = 0;                      ///< how many draws the rule of start and goal refused
};

/// Draws `count` obstacles with Rng(seed), one after the other, each in the order x, y, z, scales, s, φ. What is fixed
/// is not drawn. There are ⌊0.65 N⌋ movers; ⌊0.35 rest⌋ of the rest are pillars. A wave's φ is drawn like a trefoil's.
///
///  - paper_corridor, paper_attract, paper_repel, corridor_demo: x∈[2,72], y∈[−2,2], z∈[0,4]. Movers: cubes of 0.8 m
///    on trefoils k = 1, s = 1.1, φ∈[−2π,2π]. The rest is static, 0.4×0.4×8 m at z = 2 (z is not drawn).
///  - mader_corridor: x∈[2,75], y∈[−3,3], z∈[1,2], movers as above. The rest at x∈[1,76], y∈[−4,4] moves z − sin(t+φ):
///    pillars 0.4×0.4×4 at z = 2, beams 0.4×8×0.4 at z∈[0,3].
///  - sando_forest: x∈[5,100], y∈[−6,6], z∈[0.5,4.5]. Movers: cubes of 0.8 m on trefoils s∈[4,6], φ∈[0,3],
///    k = (U(2,4)/6, U(2,4)/5, U(2,4)/2). Static pillars are 0.4×0.4×4 at z = 2. Of the beams (0.4×0.4 m thick, 4 m
///    long) the first half, rounded down, lies along y, the others along x.
///  - step_aside: what core/world/step_aside.h draws for (seed, start). Count and goal do not matter; nothing is
///    refused.
///
/// A draw is refused, and drawn again from where the stream stands, in three cases. The obstacle's box comes within
/// kStartClearance of the start in the first kStartQuiet (sampled every 10 ms). It is static and within kEndClearance
/// of start or goal. It moves and is within kEndClearance of the goal at all of 256 instants of its period.
/// @return an Error for an unknown generator, a count outside 0 … 100000, or a rule that refuses 1000 draws in a row.
/// @param slowness  of all trefoils, instead of what was drawn
Result<GeneratedObstacles> generate(const std::string& generator, int count, std::uint64_t seed, const Vec3& start,
                                    const Vec3& goal, std::optional<double> slowness = {});

}  // namespace tern
