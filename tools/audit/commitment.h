// Reconstructs the committed trajectories from the executor's requests.
#pragma once

#include <vector>

#include "tools/audit/cubic.h"
#include "tools/audit/flight_record.h"

namespace tern::audit {

/// A trajectory that is in force from its start until the next one starts.
struct Commitment {
  TimedSpline spline;
  std::vector<Curve> curves;
  std::int64_t request = 0;  ///< id of the request that the plan answers; 0: it is no plan of this log
  bool after_gap = false;    ///< requests before it are missing, so other trajectories may have been flown in between
  bool is_stop = false;      ///< the executor's own braking trajectory, from a measured state to rest
  UTime known_until;         ///< in force at least until then, unless a later entry of the list starts earlier
};

/// Returns true for the executor's braking trajectory (rejoin). It has sixteen intervals and one acceleration per axis,
/// except where that sets in and ends. It starts from a recorded UAV_STATE, or up to one second later from the state
/// extrapolated with constant acceleration.
bool is_stop(const std::vector<UavState>& estimates, const TimedSpline& spline);

/// The trajectories that one executor committed to, in order. Each request carries the committed trajectory. After the
/// last request, the setpoints show what was adopted. A braking trajectory cancels entries that would start after it.
struct Commitments {
  std::int64_t executor = 0;  ///< sender epoch of its requests
  std::vector<Commitment> list;

  /// Returns the trajectory in force at t; before the first one, the first.
  [[nodiscard]] const Commitment& at(UTime t) const;
};
std::vector<Commitments> commitments(const FlightRecord& record);

/// Returns true if both trajectories are equal bit by bit.
bool same(const TimedSpline& a, const TimedSpline& b);

/// Returns the largest difference on any axis of position (m), velocity (m/s) or acceleration (m/s²).
double join_gap(const MotionSample& a, const MotionSample& b);

/// Returns true if the plan's outcome comes with a trajectory of its own.
inline bool brings_trajectory(const Plan& plan) {
  return plan.outcome != PlanOutcome::KeepCommitted && plan.outcome != PlanOutcome::NoPlan;
}

}  // namespace tern::audit
