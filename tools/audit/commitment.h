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
  UTime known_until;         ///< until then at least it was in force, if no later one in the list is
};

/// The trajectories that one executor flew, in order. Each request says which one was in force; what was adopted after
/// the last request is told by the setpoints that follow it.
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
