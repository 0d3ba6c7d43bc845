// A vehicle that other processes fly: an autopilot behind tern-mavlink.
#pragma once

#include "core/scenario/scenario.h"
#include "simulator/vehicle/attitude.h"
#include "simulator/vehicle/vehicle.h"

namespace tern {

/// Follows the states that the other processes publish, and joins successive states by cubics. The states are those of
/// UAV_STATE until a VEHICLE_TRUTH arrives, then those of VEHICLE_TRUTH. Until the first state the vehicle is at rest
/// at scenario.uav.start. States less than 5 ms apart count as one. The way of a jump
/// that no vehicle can fly is left out of the judgement. It ignores setpoints and publishes no state.
class ExternalVehicle final : public Vehicle {
 public:
  ExternalVehicle(const UavSpec& uav, UTime now);

  /// Takes VEHICLE_TRUTH. A state that is not after the last one is ignored.
  void receive_truth(const UavState& state);
  /// Takes UAV_STATE. Ignored after the first VEHICLE_TRUTH.
  void receive_estimate(const UavState& state);

  void receive(const UavState&) override {}
  void receive(const TimedSpline&) override {}
  void receive(const Plan&) override {}
  void advance(UTime now) override;
  [[nodiscard]] const MotionHistory& truth() const override { return truth_; }
  [[nodiscard]] UavState true_state() const override { return newest_; }
  /// The attitude of a multirotor with the newest state's acceleration and heading.
  [[nodiscard]] Eigen::Quaterniond attitude() const override { return attitude_of(newest_.motion.a, newest_.yaw); }
  [[nodiscard]] UavState estimate(UTime) override { return newest_; }
  [[nodiscard]] VehicleStatus status(UTime now) const override;
  [[nodiscard]] Limits judged_limits() const override;

 private:
  void append(const UavState& state);
  MotionHistory truth_;
  UavState newest_;
  bool has_state_ = false, has_truth_ = false;
};

}  // namespace tern
