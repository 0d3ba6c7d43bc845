// Separation by linear programming: Eq. 1 of the paper as it is written. GLPK is used here only.
#pragma once

#include <optional>

#include "core/base/types.h"
#include "core/geometry/plane.h"

namespace tern {

/// Returns a plane with n·a + d ≥ 1 on A and n·b + d ≤ −1 on B, if GLPK finds one that passes verification. The
/// inequalities hold in scaled coordinates; the result is normalised to |n| = 1.
///
/// The plane lies half way between the hulls along its normal. Its margin is not the largest possible. A call takes
/// about 25 µs; infeasible problems are solved twice. Threads may call it at the same time, because Debian's GLPK
/// keeps one environment per thread.
/// @param a, b  3×n and 3×m points, n, m ≥ 1, finite
/// @return nullopt if the hulls touch or overlap, or if rounding leaves the question in doubt
/// @throws std::invalid_argument if a set is empty or a coordinate is not finite
std::optional<Plane> separate_by_lp(const Points& a, const Points& b);

}  // namespace tern
