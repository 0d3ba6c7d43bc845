// How setpoints become a motion: the vehicle that the simulator flies.
#pragma once

#include "core/splines/motion_history.h"
#include "core/world/horizon.h"
#include "core/world/vehicle.h"
#include "core/world/vehicle_status.h"

namespace tern {

/// A simulated vehicle: body, controller and state estimator. Pure: times are arguments and never go back; whatever is
/// random comes from a seed. Before its first setpoint it stays where the scenario starts it, at rest.
///
/// The node calls receive() for each message as it comes, and at 100 Hz advance(now), then the others. Times are the
/// vehicle's clock.
class Vehicle {
 public:
  virtual ~Vehicle() = default;

  /// A SETPOINT came. Its `at` may be some ms before the time of the next advance() or, with another host's clock,
  /// ahead of it. Messages may be lost, and late. executor/commanded_motion.h makes a command at any time of this.
  virtual void receive(const UavState& setpoint) = 0;
  /// A HORIZON_REQUEST came with the trajectory that the executor has committed to: what to fly when setpoints cease.
  virtual void receive(const TimedSpline& committed) = 0;
  /// A PLAN came: what the executor will probably commit to next.
  virtual void receive(const Plan& plan) = 0;

  /// The body moves on. What it truly did is then known until truth().end(). That may lag behind `now` by a few
  /// setpoints' time, but never stands still; nothing is judged beyond it, nor beyond `now`.
  virtual void advance(UTime now) = 0;

  /// The body's true motion: consecutive cubic pieces in W, from the first advance() on and for at least 3 s back. The
  /// referee judges these pieces in continuous time, so they have to be the motion, not samples of it. A model that is
  /// integrated has a Hermite piece (core/splines) for each of its steps.
  [[nodiscard]] virtual const MotionHistory& truth() const = 0;
  /// The true state at truth().end(), with the heading: VEHICLE_TRUTH.
  [[nodiscard]] virtual UavState true_state() const = 0;
  /// What its estimator says of the state at `now` (or earlier, by its latency: `at` says when): UAV_STATE.
  [[nodiscard]] virtual UavState estimate(UTime now) = 0;
  /// How it is: VEHICLE_STATUS. Until world time begins the node says in its place that it is not following.
  [[nodiscard]] virtual VehicleStatus status(UTime now) const = 0;
  /// The true motion counts as a violation beyond these. A vehicle whose limits are those of its physics, or that only
  /// follows what keeps limits, has none: infinite ones.
  [[nodiscard]] virtual Limits judged_limits() const = 0;
};

}  // namespace tern
