// What the vehicle was committed to, put together again from its requests.
#pragma once

#include <vector>

#include "tools/audit/cubic.h"
#include "tools/audit/flight_record.h"

namespace tern::audit {

/// A trajectory in force from its start until the next one's.
struct Commitment {
  TimedSpline spline;
  std::vector<Curve> curves;
  std::int64_t request = 0;  ///< of the plan that it is; 0: no plan in the log is this one
  bool after_gap = false;    ///< requests before it are missing: others may have been flown in between
  bool is_stop = false;      ///< no plan's, but the executor's own: from a measured state to rest
  UTime known_until;         ///< until then at least it was in force, if no later one in the list is
};

/// Whether a trajectory begins where UAV_STATE said that the vehicle was, and only brakes: in sixteen intervals, with
/// one acceleration per axis but where it comes and goes. So an executor leads on a vehicle that is not where it was
/// committed to be. It may begin up to a second after that state, to which its motion at constant acceleration leads.
bool is_stop(const std::vector<UavState>& estimates, const TimedSpline& spline);

/// The trajectories that one executor flew, in order. Each request says which one was in force; what was adopted after
/// the last request is told by the setpoints that follow it. A stop takes back what would have begun after it.
struct Commitments {
  std::int64_t executor = 0;  ///< the sender epoch of its requests
  std::vector<Commitment> list;

  /// In force at t; before the first, the first.
  [[nodiscard]] const Commitment& at(UTime t) const;
};
std::vector<Commitments> commitments(const FlightRecord& record);

/// Whether two trajectories are the same to the last bit.
bool same(const TimedSpline& a, const TimedSpline& b);

/// Largest difference per axis of positions (m), velocities (m/s) and accelerations (m/s²).
double join_gap(const MotionSample& a, const MotionSample& b);

/// True for the outcomes that bring a trajectory of their own.
inline bool brings_trajectory(const Plan& plan) {
  return plan.outcome != PlanOutcome::KeepCommitted && plan.outcome != PlanOutcome::NoPlan;
}

}  // namespace tern::audit
