// Whether a contact could have been avoided: random smooth moves, tried with the truth known.
#pragma once

#include <cstdint>

#include "core/world/vehicle.h"
#include "simulator/worlds/world.h"

namespace tern {

/// A vehicle that rests in a known world.
struct RestingVehicle {
  Vec3 start = Vec3::Zero();  ///< W, m; at rest there at world time 0
  Limits limits;
  Body body;
  Box flight_box;
};

/// What a search knows that a planner does not.
struct MoveSearch {
  int moves = 10'000;
  double earliest_s = 0.2;  ///< no move begins before this world time: a planner must be asked and must answer
  double until_s = 20.0;    ///< nothing is looked at after it
  double margin = 0.02;     ///< what counts as clear, m
};

/// How many of the random moves keep clear of every obstacle from world time 0 to until_s. Each is a quintic from rest
/// to rest, p(s) = s³ (10 − 15 s + 6 s²) of the way at s = t/T. So |v| ≤ 1.875 d/T, |a| ≤ 5.774 d/T², |j| ≤ 60 d/T³ per
/// axis. Half of them are followed by a second. Begin, direction, distance (0.05 … 12 m) and how much slower than the
/// limits it is are random. Sampled every 5 ms against boxes grown by the body's half-extents and the margin.
/// @return the number of clear moves; ends at `enough` of them
int clear_moves(const RestingVehicle& vehicle, const World& world, std::uint64_t seed, const MoveSearch& search,
                int enough = 1);

}  // namespace tern
