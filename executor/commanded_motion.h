// What a vehicle is told to do, as the one who follows hears it: setpoints, and what comes after the newest one.
#pragma once

#include <optional>

#include "core/splines/motion_history.h"
#include "core/world/horizon.h"
#include "core/world/vehicle.h"
#include "executor/committed_trajectory.h"

namespace tern {

/// After this long without a SETPOINT the executor counts as gone: three of them may be lost, and a busy machine may
/// hold it up for a while.
inline constexpr Duration kSetpointSilence{100'000};

/// The commanded motion as a vehicle (simulator, autopilot bridge) reconstructs it from SETPOINT and from the committed
/// trajectory that each HORIZON_REQUEST carries.
///
/// Between two setpoints it is the cubic of the first (p, v, a, j). Where a message between them was lost, the
/// committed trajectory may pass through both and that cubic not: then it is that trajectory. After the newest setpoint
/// it is the committed trajectory, if that passes through the setpoint within kJoinTolerance. Else it is the braking
/// trajectory, after 20 ms of the setpoint's cubic. Both end at rest. So a vehicle whose executor has died flies on
/// along what was certified, and rests at its end.
class CommandedMotion {
 public:
  /// At rest at p (W, m) until the first setpoint. @param limits  for braking
  CommandedMotion(const Vec3& p, UTime from, const Limits& limits);

  /// The next setpoint. One that is not after settled().end() is ignored. The command may not lead to it within
  /// kJoinTolerance, or it may be 0.2 s ahead. Such a one counts only when the next one goes on from it, as after a
  /// lost setpoint: no single message makes the vehicle jump. After kSetpointSilence setpoints that are more than 0.1 m
  /// off count only when they have gone on for 0.5 s. An executor that sees where the vehicle is leads it on from there
  /// before.
  void receive(const UavState& setpoint);
  /// HORIZON_REQUEST.committed. One that starts after all earlier ones is news in three cases. It joins them, what came
  /// before it was not heard, or setpoints that the command does not lead to lie on it. So is one that leaves, before
  /// they start, the way that the vehicle is on. Then the executor leads it on from where it is, and they are taken
  /// back.
  void receive(const TimedSpline& committed);
  /// PLAN: what will probably be committed, told up to a request's period before HORIZON_REQUEST says so. If it joins
  /// the command, acceleration_ahead() looks at it until then, or until it was to begin. The command itself waits until
  /// it is committed.
  void receive(const Plan& plan);

  /// The command at any time; before settled().end() as it was, after it as it would be without another setpoint.
  [[nodiscard]] MotionSample sample(UTime t) const;
  /// The acceleration at t + lead (m/s²), for who has to tilt first: of the plan that comes next, else of what is
  /// committed. Where a braking trajectory stands in for that, it is by the jerk at t.
  [[nodiscard]] Vec3 acceleration_ahead(UTime t, Duration lead) const;
  [[nodiscard]] double yaw() const { return yaw_; }  ///< rad, of the newest setpoint
  /// Whether the command after settled().end() is a trajectory that was heard to be committed, not one that brakes.
  [[nodiscard]] bool is_committed() const { return !braking_; }

  /// What can no longer change. Ends at the newest setpoint, or where settle() has ended it.
  [[nodiscard]] const MotionHistory& settled() const { return settled_; }
  /// Gives up waiting for setpoints up to `until`: the command until then is what comes after the newest one.
  /// @return whether anything was missing
  bool settle(UTime until);
  void forget_before(UTime t) { settled_.forget_before(t); }

 private:
  /// Whether setpoints to which the command does not lead have come for long enough.
  bool accepts_departure(const UavState& setpoint, bool is_far);
  [[nodiscard]] const CommittedTrajectory& after() const { return braking_ ? *braking_ : committed_; }
  void choose_continuation(const MotionSample& motion, UTime at);

  Limits limits_;
  MotionHistory settled_;
  MotionSample newest_;                ///< at settled_.end(), with the jerk that follows
  UTime received_until_;               ///< the time of the newest setpoint that was heard; `from` before the first one
  std::optional<UavState> departure_;  ///< the newest setpoint, where the command did not lead to it
  UTime departed_since_;               ///< the first of the setpoints that lead to it
  double yaw_ = 0.0;
  CommittedTrajectory committed_;  ///< as heard
  struct Planned {
    UTime start;
    ClampedSpline spline;
  };
  std::optional<Planned> planned_;              ///< joins it, and is not yet committed
  std::optional<CommittedTrajectory> braking_;  ///< when committed_ does not pass through the newest setpoint
};

/// The trajectory that leaves `from` at `at` and comes to rest soonest while it keeps `limits`, dynamics included. It
/// is sought among splines of sixteen equal intervals whose acceleration is constant per axis but where it comes and
/// goes. If none keeps the limits (the vehicle is beyond them already), it is the one that exceeds those per axis
/// least.
TimedSpline braking_trajectory(const MotionSample& from, UTime at, const Limits& limits);

}  // namespace tern
