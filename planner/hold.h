// The hold: how long an end of a plan must stay clear, and how far ahead that is looked at.
#pragma once

#include <limits>
#include <vector>

#include "core/world/horizon.h"
#include "planner/problem/planner_config.h"
#include "planner/safety/swept_obstacles.h"

namespace tern {

/// What one request asks of the ends of its plans. Times are seconds from t_s.
struct HoldDemand {
  double required_s = 0.5;  ///< an end that stays clear this long is preferred to one that does not
  double cap_s = 1.5;       ///< how far a hold is followed
  double until_s = std::numeric_limits<double>::infinity();  ///< no hold is asked for later than this
  double side_step_s = 0.0;    ///< what this vehicle needs to step out of a mover's way (side_step_time)
  double predicted_s = 0.0;    ///< how far the predictions of what moves nearby reach
  bool none_estimated = true;  ///< all that moves nearby is promised, nothing estimated
  double width = 0.0;          ///< of vehicle and largest mover together: half-extents, added, m

  /// What an end reached at `end_s` should hold to be preferred, s. Where predictions widen with time, a hold after a
  /// long plan asks for more than one after a short plan, so standing still would win. `until_s` makes them equal.
  /// Besides, the plan must stay clear from t_s on for as long as this vehicle needs to step aside, as far as
  /// predictions reach. An evasion that begins when that no longer holds still has its time.
  [[nodiscard]] double required(double end_s) const;
  /// How far the hold of an end reached at `end_s` is followed: never less than is asked for.
  [[nodiscard]] double cap(double end_s) const;
  /// How far the hold of a stop that is flown to step aside, or to wait, is followed: as far as predictions reach.
  [[nodiscard]] double cap_of_stop(double end_s) const;
};

/// The least time in which this vehicle, at rest, leaves the way of a mover, s. It is the time from rest to rest over
/// the width of both (half-extents) along the second quickest axis, times kStopScale. (A mover may come along the
/// quickest.)
double side_step_time(const Limits& limits, const Vec3& body_half, const Vec3& mover_half);

/// What the request asks for among these obstacles: the largest mover's size per axis, the predictions that reach
/// farthest. Configured holds take half the horizon at most, so that flying has the other half.
HoldDemand hold_demand(const HorizonRequest& request, const PlannerConfig& config,
                       const std::vector<PlanningObstacle>& obstacles, double horizon_s);

}  // namespace tern
