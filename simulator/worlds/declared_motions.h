// DECLARED_MOTIONS: the future motions of a world's obstacles, as piecewise cubics with a proven error.
#pragma once

#include "core/base/time.h"
#include "core/world/track.h"
#include "simulator/worlds/coarse_motions.h"
#include "simulator/worlds/world.h"

namespace tern {

/// Largest error of the pieces of an oscillation, m per axis.
inline constexpr double kFitError = 5e-3;
/// Added to α of every moving obstacle: rounding in the evaluation of pieces at up to 1e5 m from the origin, m.
inline constexpr double kFitRounding = 1e-9;

/// Grid of the joints: the length of a piece is a multiple of it.
inline constexpr Duration kGridUnit{10'000};

/// Returns the length h of the Hermite pieces for a motion with these bounds. It is the longest multiple of 10 ms in
/// [10 ms, 2 s] with h⁴/384 · max|p⁗| ≤ kFitError. The paper's trefoils have 0.43 s, SANDO's about 1.3 s.
Duration fit_piece(const ObstacleBounds& bounds);

/// Returns the declared motions over [from, to], by id ascending. An obstacle that is absent all that time has none.
///
/// | obstacle           | pieces                                      | α                                    |
/// |--------------------|---------------------------------------------|--------------------------------------|
/// | static             | one, kind Static                            | 0                                    |
/// | oscillation        | cubic Hermite, on the grid k·fit_piece      | hermite_error_bound + kFitRounding   |
/// | linear, waypoints  | its own straight pieces                     | kFitRounding                         |
/// | coarse: a Box      | one, at rest in the middle of the box       | half the box + kFitRounding          |
/// | coarse: another    | as in `coarse`                              | as in `coarse`, + kFitRounding       |
///
/// The fixed grid makes successive sets agree piece by piece. Before world_zero everything is at rest. The track of an
/// obstacle that appears or vanishes covers only its presence. top_speed is the true bound on the largest axis. The set
/// has made_at = from, confidence 1, and an empty header and batch. Pure; O(pieces).
/// @throws std::invalid_argument unless from < to.
TrackSet declare_motions(const World& world, UTime world_zero, UTime from, UTime to, const CoarseMotions& coarse = {});

}  // namespace tern
