// DECLARED_MOTIONS: what the movers of a world promise, as piecewise cubics with a proven error.
#pragma once

#include "core/base/time.h"
#include "core/world/track.h"
#include "simulator/worlds/coarse_motions.h"
#include "simulator/worlds/world.h"

namespace tern {

/// Pieces of oscillating motions are as long as this error allows, m per axis.
inline constexpr double kFitError = 5e-3;
/// Added to α of everything that moves: rounding of the pieces' evaluation at up to 1e5 m from the origin, m.
inline constexpr double kFitRounding = 1e-9;

/// The grid of their joints: pieces are a multiple of it.
inline constexpr Duration kGridUnit{10'000};

/// Length of the Hermite pieces for a motion with these bounds. It is the longest multiple of 10 ms with h⁴/384 ·
/// max|p⁗| ≤ kFitError, from 10 ms to 2 s. It is 0.43 s for the paper's trefoils, about 1.3 s for SANDO's.
Duration fit_piece(const ObstacleBounds& bounds);

/// What is promised of the world over [from, to], by id ascending; nothing of those who are absent all that time.
///
/// Static obstacles: one piece, kind Static, α = 0. Oscillations: cubic Hermite pieces on the fixed grid k·fit_piece of
/// world time, covering [from, to]. So successive sets agree piece by piece. α = hermite_error_bound per axis +
/// kFitRounding. Linear and waypoint motions: their own straight pieces, α = kFitRounding. Before world_zero everything
/// rests. A track of an obstacle that appears or vanishes covers only the time of its presence. top_speed is the
/// largest axis' true bound. Who is in `coarse` is declared as it says, with kFitRounding more. Too fast to be followed
/// means one piece at rest in the middle of its box, with half the box as α. The set has made_at = from, confidence 1,
/// empty header and batch. Pure; O(pieces).
/// @throws std::invalid_argument unless from < to.
TrackSet declare_motions(const World& world, UTime world_zero, UTime from, UTime to, const CoarseMotions& coarse = {});

}  // namespace tern
