// The simulated vehicle's interface: setpoints in, motion out.
#pragma once

#include "core/splines/motion_history.h"
#include "core/world/horizon.h"
#include "core/world/vehicle.h"
#include "core/world/vehicle_status.h"

namespace tern {

class Navigation;

/// A simulated vehicle: body, controller and state estimator. Pure: times are arguments and never go back, and noise
/// comes from a seed. Before its first setpoint it rests at the scenario's start.
///
/// The node calls receive() for each message, and at 100 Hz advance(now), then the queries. Times are the vehicle's
/// clock.
class Vehicle {
 public:
  virtual ~Vehicle() = default;

  /// Takes a SETPOINT. Its `at` may be some ms before the next advance(), or ahead of it with another host's clock.
  /// Messages may be lost or late; executor/commanded_motion.h turns them into a command at any time.
  virtual void receive(const UavState& setpoint) = 0;
  /// Takes HORIZON_REQUEST.committed: the trajectory to fly when setpoints cease.
  virtual void receive(const TimedSpline& committed) = 0;
  /// Takes a PLAN: the trajectory that the executor will probably commit to next.
  virtual void receive(const Plan& plan) = 0;

  /// Advances the body. Afterwards its true motion is known until truth().end(), which may lag `now` by a few setpoints
  /// but always progresses. The motion is judged up to truth().end() and `now`.
  virtual void advance(UTime now) = 0;

  /// The body's true motion in W: consecutive cubic pieces, from the first advance() on, at least the last 3 s. The
  /// referee judges these pieces in continuous time, so they must be the motion itself. An integrated model has one
  /// Hermite piece (core/splines) per step.
  [[nodiscard]] virtual const MotionHistory& truth() const = 0;
  /// The true state at truth().end(), with the heading: VEHICLE_TRUTH.
  [[nodiscard]] virtual UavState true_state() const = 0;
  /// The body's true attitude at truth().end(): the rotation from B to W.
  [[nodiscard]] virtual Eigen::Quaterniond attitude() const = 0;
  /// The estimated state at `now`, or earlier by the latency (see `at`): UAV_STATE.
  [[nodiscard]] virtual UavState estimate(UTime now) = 0;
  /// VEHICLE_STATUS. Before world zero the node replaces `following` by false.
  [[nodiscard]] virtual VehicleStatus status(UTime now) const = 0;
  /// Limits beyond which the true motion counts as a violation. They are infinite for a vehicle whose limits are
  /// physical, or that only follows motions within limits.
  [[nodiscard]] virtual Limits judged_limits() const = 0;
  /// The vehicle's navigation, if it flies on the estimate of tern-estimator (simulator.estimation: vio).
  [[nodiscard]] virtual Navigation* navigation() { return nullptr; }
};

}  // namespace tern
