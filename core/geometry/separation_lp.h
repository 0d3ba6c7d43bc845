// Separation by linear programming (GLPK): the paper's Eq. 1 as it is written. The only GLPK in Tern.
#pragma once

#include <optional>

#include "core/base/types.h"
#include "core/geometry/plane.h"

namespace tern {

/// A plane with n·a + d ≥ 1 (scaled) on A and ≤ −1 on B if GLPK finds one, normalised to |n| = 1 and verified.
///
/// @param a, b  3×n and 3×m points, n, m ≥ 1, finite.
/// @throws std::invalid_argument for an empty set or a coordinate that is not finite.
/// @return the plane half way between the hulls for its normal, not the one of widest margin. Else nullopt: the hulls
///   touch or overlap, or rounding leaves it in doubt. Thread-safe per thread (glp environment is thread-local in
///   Debian's build). About 25 µs; infeasible problems are tried twice.
std::optional<Plane> separate_by_lp(const Points& a, const Points& b);

}  // namespace tern
