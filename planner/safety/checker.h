// The one checker: decides every answer, in flight and in tests. What it passes is certified.
#pragma once

#include <cstdint>
#include <vector>

#include "core/world/flyable.h"
#include "core/world/horizon.h"
#include "planner/problem/horizon_problem.h"
#include "planner/safety/interval_separation.h"
#include "planner/safety/swept_obstacles.h"

namespace tern {

/// The first rule broken, or the certificate.
struct CheckReport : BreachReport {
  std::int64_t obstacle = 0;                       ///< which was not separated
  std::vector<CertificatePlane> certificate = {};  ///< a plane for every pair whose boxes overlap
  PairCounts pairs = {};
};

/// Checks a new plan against everything: breach_of(), then S with kLimitTolerance, then Eq. 1.
/// @param obstacles  origin t_s; its first J intervals are the plan's. It holds every obstacle that can touch the
/// sphere, not only those that a solver saw.
CheckReport check_plan(const TimedSpline& plan, const HorizonProblem& problem, SweptObstacles& obstacles);

/// Checks only Eq. 1 for a motion already committed to: pieces in powers of u, one per interval of `obstacles`.
CheckReport check_separation(const std::vector<PowerCubic>& pieces, SweptObstacles& obstacles);

}  // namespace tern
