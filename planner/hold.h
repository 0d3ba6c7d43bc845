// The terminal clear time (hold): how long an end must stay clear, and for how long that is tested. See
// docs/planner/holds.md.
#pragma once

#include <limits>
#include <vector>

#include "core/world/horizon.h"
#include "planner/problem/planner_config.h"
#include "planner/safety/swept_obstacles.h"

namespace tern {

/// The holds that one request asks of its plans. Times are seconds after t_s.
struct HoldDemand {
  double required_s = 0.5;  ///< an end that stays clear this long is preferred to one that does not
  double cap_s = 1.5;       ///< a hold is tested for this long
  double until_s = std::numeric_limits<double>::infinity();  ///< no hold is required beyond this time
  double side_step_s = 0.0;    ///< time in which the vehicle steps out of a mover's way (side_step_time)
  double predicted_s = 0.0;    ///< last time for which any mover nearby is predicted
  bool has_estimated = false;  ///< a mover nearby is estimated
  double width = 0.0;          ///< sum of half-extents of vehicle and largest mover, largest axis, m

  /// Returns the hold that an end reached at end_s must have to be preferred, s:
  ///
  ///     clamp(until_s − end_s, 0, max(required_s, min(side_step_s, predicted_s) − end_s))
  ///
  /// The plan thus stays clear from t_s on for at least a side step. If a later plan no longer does, an evasion that
  /// starts then is still in time. Where predictions widen with time, a long plan has a hold less often than a short
  /// one, so staying would always be preferred. until_s makes up for that.
  [[nodiscard]] double required(double end_s) const;
  /// Returns for how long the hold of an end reached at end_s is tested, s: at least required(end_s).
  [[nodiscard]] double cap(double end_s) const;
  /// Returns for how long the hold of a stop is tested, s: as far as predictions reach. At a stop the vehicle waits, or
  /// it evades to it.
  [[nodiscard]] double cap_of_stop(double end_s) const;
};

/// Returns the least time in which this vehicle, at rest, leaves the way of a mover, s.
///
/// It is kStopScale times the least time from rest to rest over both half-extents along the second quickest axis. The
/// quickest axis may be the one along which the mover comes.
double side_step_time(const Limits& limits, const Vec3& body_half, const Vec3& mover_half);

/// Returns the holds for a request among these obstacles.
///
/// The configured holds are cut to half the horizon, so that the other half is left for flying. side_step_s is the
/// longest over all movers. until_s is the mean over the estimated movers of the time for which their α stays within
/// the width of mover and vehicle. Of the three axes this width is the middle one.
HoldDemand hold_demand(const HorizonRequest& request, const PlannerConfig& config,
                       const std::vector<PlanningObstacle>& obstacles, double horizon_s);

}  // namespace tern
