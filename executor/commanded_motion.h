// The commanded motion at any time, as the vehicle reconstructs it from setpoints and committed trajectories.
#pragma once

#include <optional>

#include "core/splines/motion_history.h"
#include "core/world/horizon.h"
#include "core/world/vehicle.h"
#include "executor/committed_trajectory.h"

namespace tern {

/// After this long without a SETPOINT the executor counts as gone. Three setpoints may be lost, or the executor may be
/// held up by a busy machine.
inline constexpr Duration kSetpointSilence{100'000};

/// The commanded motion as a vehicle (simulator, autopilot bridge) reconstructs it. The sources are SETPOINT, the
/// committed trajectory that each HORIZON_REQUEST contains, and PLAN.
///
/// | time                                | command                                                                 |
/// |-------------------------------------|-------------------------------------------------------------------------|
/// | between two setpoints               | the cubic of the first (p, v, a, j)                                     |
/// | the same, a setpoint was lost       | the committed trajectory, if it alone passes through both               |
/// | after the newest setpoint           | the committed trajectory, if it passes within kJoinTolerance of it      |
/// | the same, it does not pass          | the setpoint's cubic for 20 ms, then braking_trajectory()               |
///
/// Both last rows end at rest. So a vehicle whose executor has died flies on along the certified trajectory, and is
/// stationary at its end.
class CommandedMotion {
 public:
  /// Constructs a command at rest at p (W, m) until the first setpoint. @param limits  for braking
  CommandedMotion(const Vec3& p, UTime from, const Limits& limits);
  /// Constructs the command that begins with this setpoint, as for a vehicle's bridge that joins a flight.
  CommandedMotion(const UavState& setpoint, const Limits& limits);

  /// Takes a SETPOINT.
  ///
  /// | setpoint                                              | effect                                              |
  /// |-------------------------------------------------------|-----------------------------------------------------|
  /// | not after settled().end()                             | ignored                                             |
  /// | within kJoinTolerance of the command, ≤ 0.2 s ahead   | accepted                                            |
  /// | a departure: any other                                | ignored; setpoints that continue it are accepted    |
  /// | a departure of > 0.1 m after kSetpointSilence         | the same, once the departure has lasted for 0.5 s   |
  ///
  /// So no single message makes the vehicle jump. An executor that receives UAV_STATE needs less than the 0.5 s to
  /// continue from the vehicle's position instead.
  void receive(const UavState& setpoint);
  /// Takes HORIZON_REQUEST.committed. A trajectory that starts after all earlier ones is appended if
  /// - it joins them, or
  /// - the command brakes, since the trajectory before this one was not received, or
  /// - setpoints that depart from the command lie on it.
  ///
  /// A trajectory that starts earlier, after settled().end() and on the current command, replaces the later segments:
  /// the executor leads the vehicle on from there.
  void receive(const TimedSpline& committed);
  /// Takes a PLAN. The command does not change until a HORIZON_REQUEST reports that the plan was adopted, up to one
  /// request period later. If the plan joins the command, acceleration_ahead() uses it until that report, or until the
  /// plan starts.
  void receive(const Plan& plan);

  /// The command at any t. After settled().end() it is the command without another setpoint.
  [[nodiscard]] MotionSample sample(UTime t) const;
  /// The acceleration at t + lead (m/s², W), for a vehicle that must tilt first. If the received plan starts before
  /// that time, it is the plan's; else the committed trajectory's. While the command brakes it is a(t) + lead·j(t).
  [[nodiscard]] Vec3 acceleration_ahead(UTime t, Duration lead) const;
  [[nodiscard]] double yaw() const { return yaw_; }  ///< rad, of the newest setpoint
  /// Whether the command after settled().end() is a committed trajectory. False: it brakes.
  [[nodiscard]] bool is_committed() const { return !braking_; }

  /// The part of the command that is final. It ends at the newest setpoint, or at the time given to settle().
  [[nodiscard]] const MotionHistory& settled() const { return settled_; }
  /// Stops waiting for setpoints up to `until`: the continuation of the newest setpoint becomes final until then.
  /// @return whether this changed settled()
  bool settle(UTime until);
  void forget_before(UTime t) { settled_.forget_before(t); }

 private:
  /// Whether a setpoint that departs from the command is accepted. @param is_far  by more than 0.1 m
  bool accepts_departure(const UavState& setpoint, bool is_far);
  [[nodiscard]] const CommittedTrajectory& continuation() const { return braking_ ? *braking_ : committed_; }
  void choose_continuation(const MotionSample& motion, UTime at);

  Limits limits_;
  MotionHistory settled_;
  MotionSample newest_;                ///< at settled_.end(), with the jerk that follows
  UTime received_until_;               ///< time of the newest accepted setpoint; `from` before the first one
  std::optional<UavState> departure_;  ///< the newest setpoint, if it departs from the command
  UTime departed_since_;               ///< time of the first setpoint of this departure
  double yaw_ = 0.0;
  CommittedTrajectory committed_;  ///< as received
  struct Planned {
    UTime start;
    ClampedSpline spline;
  };
  std::optional<Planned> planned_;              ///< a plan that joins the command and is not committed yet
  std::optional<CommittedTrajectory> braking_;  ///< if committed_ does not pass through the newest setpoint
};

/// Returns the trajectory that leaves `from` at `at` and comes to rest soonest within `limits`, dynamics included. The
/// candidates are splines of sixteen equal intervals. Their acceleration per axis is constant except for ramps at both
/// ends. If no candidate keeps the limits (the vehicle exceeds them already), it is the one that exceeds the limits per
/// axis least.
TimedSpline braking_trajectory(const MotionSample& from, UTime at, const Limits& limits);

}  // namespace tern
