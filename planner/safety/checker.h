// The checker: it certifies every trajectory that plan() returns, in flight and in tests.
#pragma once

#include <cstdint>
#include <vector>

#include "core/world/flyable.h"
#include "core/world/horizon.h"
#include "planner/problem/horizon_problem.h"
#include "planner/safety/interval_separation.h"

namespace tern {

/// The first rule that is broken, or the certificate.
struct CheckReport : BreachReport {
  std::int64_t obstacle = 0;                       ///< id of the first obstacle that is not separated
  std::vector<CertificatePlane> certificate = {};  ///< a plane for every pair whose boxes overlap
  PairCounts pairs = {};
};

/// Checks a new plan: breach_of() (start, limits, end at rest, flight box), then S with kLimitTolerance, then Eq. 1.
/// @param cache  its obstacles have the origin t_s; the first J intervals are the plan's. They must be all obstacles
/// that can touch the sphere, not only those that a solver used.
CheckReport check_plan(const TimedSpline& plan, const HorizonProblem& problem, SeparationCache& cache);

/// Checks only Eq. 1, for a motion that is already committed.
/// @param pieces  in powers of u ∈ [0, 1], one per interval of the obstacles
CheckReport check_separation(const std::vector<PowerCubic>& pieces, SeparationCache& cache);

}  // namespace tern
