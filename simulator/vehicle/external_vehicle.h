// A vehicle that others fly: an autopilot behind tern-mavlink.
#pragma once

#include "core/world/scenario.h"
#include "simulator/vehicle/vehicle.h"

namespace tern {

/// Its truth is what is heard of it: cubics through the states that are told, VEHICLE_TRUTH, or UAV_STATE from whoever
/// tells no truth. Until the first it rests at scenario.uav.start. It follows what it is told elsewhere, and says
/// nothing of itself.
class ExternalVehicle final : public Vehicle {
 public:
  ExternalVehicle(const UavSpec& uav, UTime now);

  /// A state that is not after the last one is ignored.
  void receive_truth(const UavState& state);
  /// Counts only until a truth was heard.
  void receive_estimate(const UavState& state);

  void receive(const UavState&) override {}
  void receive(const TimedSpline&) override {}
  void receive(const Plan&) override {}
  void advance(UTime now) override;
  [[nodiscard]] const MotionHistory& truth() const override { return truth_; }
  [[nodiscard]] UavState true_state() const override { return newest_; }
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
