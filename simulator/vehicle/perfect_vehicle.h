// A vehicle that follows its setpoints exactly.
#pragma once

#include "core/scenario/scenario.h"
#include "executor/commanded_motion.h"
#include "simulator/vehicle/vehicle.h"

namespace tern {

/// Follows the commanded motion exactly, and knows its state exactly. Its truth ends at the newest setpoint. In a
/// silence it lags by 0.5 s, so that a setpoint which is less than 0.5 s late is followed. A setpoint that jumps makes
/// the vehicle jump, which the referee counts.
class PerfectVehicle final : public Vehicle {
 public:
  PerfectVehicle(const UavSpec& uav, UTime now) : limits_(uav.limits), command_(uav.start, now, uav.limits) {}

  void receive(const UavState& setpoint) override { command_.receive(setpoint); }
  void receive(const TimedSpline& committed) override { command_.receive(committed); }
  void receive(const Plan& plan) override { command_.receive(plan); }
  void advance(UTime now) override;
  [[nodiscard]] const MotionHistory& truth() const override { return command_.settled(); }
  [[nodiscard]] UavState true_state() const override { return state_at(truth().end()); }
  [[nodiscard]] Eigen::Quaterniond attitude() const override;
  /// Returns the state at `now` on the committed trajectory, or the state at the newest setpoint if the command brakes.
  [[nodiscard]] UavState estimate(UTime now) override {
    return state_at(command_.is_committed() ? now : truth().end());
  }
  [[nodiscard]] VehicleStatus status(UTime now) const override;
  [[nodiscard]] Limits judged_limits() const override { return limits_; }

 private:
  [[nodiscard]] UavState state_at(UTime t) const;

  Limits limits_;
  CommandedMotion command_;
};

}  // namespace tern
