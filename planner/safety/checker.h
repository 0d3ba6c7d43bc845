// The one checker: decides every answer, in flight and in tests. What it passes is certified.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/world/horizon.h"
#include "planner/horizon_problem.h"
#include "planner/safety/interval_separation.h"
#include "planner/safety/swept_obstacles.h"

namespace tern {

enum class CheckFault {
  None,
  Shape,     ///< fewer than 4 or more than kMaxIntervals intervals, Δt ≤ 0, or a number that is not finite
  Start,     ///< does not join the start state
  Velocity,  ///< at its true extremum
  Acceleration,
  Jerk,
  NotAtRest,      ///< does not end with q_{n-2} = q_{n-1} = q_n
  Sphere,         ///< a MINVO point leaves S
  FlightBox,      ///< the body leaves the flight box
  NotSeparated,   ///< an obstacle is not separated from an interval
  TooManyPlanes,  ///< the certificate does not fit into a plan (kMaxCertificatePlanes)
};
const char* to_string(CheckFault fault);

/// The first fault, in the order of the enumeration, or the certificate.
struct CheckReport {
  CheckFault fault = CheckFault::None;
  int interval = -1;  ///< where, if it is in one
  int axis = -1;
  double value = 0.0, limit = 0.0;            ///< what was found and what was allowed
  std::int64_t obstacle = 0;                  ///< which was not separated
  std::vector<CertificatePlane> certificate;  ///< a plane for every pair whose boxes overlap
  PairCounts pairs;
  [[nodiscard]] bool ok() const { return fault == CheckFault::None; }
};

/// Checks a new plan against everything: the limits with kLimitTolerance at the true extrema, the centre's box to
/// kBoxTolerance. @param obstacles  origin t_s, its first J intervals are the plan's, and it
/// holds every obstacle that can touch the sphere: not only those that a solver saw.
CheckReport check_plan(const TimedSpline& plan, const HorizonProblem& problem, SweptObstacles& obstacles);

/// Checks only Eq. 1 for a motion already committed to: pieces in powers of u, one per interval of `obstacles`.
CheckReport check_separation(const std::vector<PowerCubic>& pieces, SweptObstacles& obstacles);

}  // namespace tern
