// Seeded encounters in which a vehicle at rest must step aside for approaching obstacles.
#pragma once

#include <cstdint>
#include <vector>

#include "core/scenario/scenario.h"
#include "core/world/vehicle.h"

namespace tern {

/// No obstacle touches the vehicle's start before this world's time, s. It exceeds the 4.5 s for which motions are
/// declared ahead.
inline constexpr double kStepAsideQuiet = 4.8;

/// One encounter: a vehicle with limits of its own, and one to five boxes on straight lines through its position.
struct StepAside {
  Limits limits;
  Body body;
  std::vector<ObstacleSpec> movers;  ///< with LinearMotion
};

/// Returns the encounter of a seed. Rng(seed) draws in this order:
///
/// 1. The vehicle: v_max log-uniform in [0.5, 6] m/s; a_max log-uniform in [1, 20] m/s², half of it on z. One vehicle
///    in five has no jerk limit; the others have j_max log-uniform in [5, 200] m/s³. The body is a sphere with a
///    radius log-uniform in [0.1, 0.4] m.
/// 2. One to five obstacles. Half-extents are log-uniform in [0.1, 1.5] m per axis, directions are uniform on the
///    sphere, speeds are log-uniform in [0.4 m/s, 2 v_max].
/// 3. The path of each: a random point of its box, enlarged by the radius, passes through the start. It first touches
///    a vehicle that stays there at a time uniform in [kStepAsideQuiet, kStepAsideQuiet + 4] s.
StepAside draw_step_aside(std::uint64_t seed, const Vec3& start);

}  // namespace tern
