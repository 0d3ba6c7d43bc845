// The quadrotor model as a Vehicle.
#pragma once

#include <cstdint>

#include "core/world/scenario.h"
#include "executor/commanded_motion.h"
#include "simulator/vehicle/quadrotor_model.h"
#include "simulator/vehicle/vehicle.h"

namespace tern {

/// The vehicle, the wind and the estimator.
struct QuadrotorFlight {
  QuadrotorConfig quadrotor;
  WindSpec wind;
  EstimatorSpec estimator;
};

/// Follows the commanded motion (executor/commanded_motion.h) as well as its controller can. Its only limits are
/// physical. The ground is the floor of the flight box.
class QuadrotorVehicle final : public Vehicle {
 public:
  QuadrotorVehicle(const UavSpec& uav, const QuadrotorFlight& flight, std::uint64_t seed, UTime now);

  void receive(const UavState& setpoint) override { command_.receive(setpoint); }
  void receive(const TimedSpline& committed) override { command_.receive(committed); }
  void receive(const Plan& plan) override { command_.receive(plan); }
  void advance(UTime now) override;
  [[nodiscard]] const MotionHistory& truth() const override { return truth_; }
  [[nodiscard]] UavState true_state() const override;
  [[nodiscard]] UavState estimate(UTime now) override;
  [[nodiscard]] VehicleStatus status(UTime now) const override;
  [[nodiscard]] Limits judged_limits() const override;

 private:
  EstimatorSpec estimator_;
  Duration lead_;
  QuadrotorModel model_;
  CommandedMotion command_;
  MotionHistory truth_;
  MotionSample newest_;  ///< at truth_.end()
  UavState published_;
};

}  // namespace tern
