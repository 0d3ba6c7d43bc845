// Judges whether a contact was avoidable, by random smooth moves in a world whose motion is known.
#pragma once

#include <cstdint>

#include "core/world/vehicle.h"
#include "simulator/worlds/world.h"

namespace tern {

/// A stationary vehicle in a known world.
struct RestingVehicle {
  Vec3 start = Vec3::Zero();  ///< W, m; the vehicle is at rest there at world time 0
  Limits limits;
  Body body;
  Box flight_box;
};

/// The parameters of the search.
struct MoveSearch {
  int moves = 10'000;
  double earliest_s = 0.2;  ///< earliest start of a move in world time: a planner needs time to be asked and to answer
  double until_s = 20.0;    ///< end of the examined time
  double margin = 0.02;     ///< least clearance of a clear move, m
};

/// Counts the random moves that stay clear of every obstacle from world time 0 to until_s.
///
/// A move is a quintic from rest to rest. At s = t/T it has covered the share s³ (10 − 15 s + 6 s²) of its distance d.
/// Per axis |v| ≤ 1.875 d/T, |a| ≤ 5.774 d/T², |j| ≤ 60 d/T³. Start time, direction, distance (0.05 … 12 m) and a
/// slowdown against the limits are random. Half of the moves are followed by a second one. Moves are sampled every 5 ms
/// against boxes grown by the body's half-extents and the margin.
/// @return the number of clear moves; the search ends at `enough` of them
int clear_moves(const RestingVehicle& vehicle, const World& world, std::uint64_t seed, const MoveSearch& search,
                int enough = 1);

}  // namespace tern
