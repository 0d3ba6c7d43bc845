// The message PLAN_HEADING: the yaw along a plan.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/time.h"
#include "core/wire/header.h"

namespace tern {

/// PLAN_HEADING: the yaw along the trajectory of one PLAN, as a clamped uniform cubic spline on the trajectory's knots.
/// After its end the yaw stays.
struct PlanHeading {
  Header header;
  std::int64_t request_id = 1;         ///< of the plan
  MessageName request;                 ///< the request that the plan answers
  UTime start;                         ///< of the spline
  Duration interval{250'000};          ///< Δt, that of the plan
  std::vector<double> control_points;  ///< yaw, rad, about W's z from W's x; continuous, so it may leave (−π, π]
  double rate_max = 1.0;               ///< rad/s, > 0, the limit that was kept
  double acceleration_max = 1.0;       ///< rad/s², > 0, the limit that was kept
  // The value of each term, in the units of the planner's cost.
  double path_term = 0.0, track_term = 0.0, unseen_term = 0.0, texture_term = 0.0;
};

}  // namespace tern
