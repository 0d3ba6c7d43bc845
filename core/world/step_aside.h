// Who must step aside, and for what: a seeded vehicle at rest and the movers that come at it.
#pragma once

#include <cstdint>
#include <vector>

#include "core/world/scenario.h"
#include "core/world/vehicle.h"

namespace tern {

/// No mover touches the vehicle's start before this world time, s: motions are declared 4.5 s ahead.
inline constexpr double kStepAsideQuiet = 4.8;

/// One encounter: a vehicle with limits of its own and one to five boxes on straight lines through where it rests.
struct StepAside {
  Limits limits;
  Body body;
  std::vector<ObstacleSpec> movers;  ///< motion linear
};

/// A pure function of (seed, start). Draws, in this order, from Rng(seed):
///  vehicle: v_max log-uniform in [0.5, 6] m/s; a_max log-uniform in [1, 20] m/s², half of it on z. One in five has no
///    jerk limit, the others j_max log-uniform in [5, 200] m/s³. A sphere of radius log-uniform in [0.1, 0.4] m.
///  movers: one to five, each with half-extents log-uniform in [0.1, 1.5] m per axis. A direction is uniform on the
///  sphere, a speed log-uniform in [0.4 m/s, 2 v_max]. A drawn point of its box (grown by the radius) goes through the
///  start. It first touches a vehicle that stays there at a time uniform in [kStepAsideQuiet, kStepAsideQuiet + 4] s.
StepAside draw_step_aside(std::uint64_t seed, const Vec3& start);

}  // namespace tern
