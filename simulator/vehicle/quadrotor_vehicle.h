// The quadrotor model as a Vehicle.
#pragma once

#include <cstdint>
#include <optional>

#include "core/scenario/scenario.h"
#include "executor/commanded_motion.h"
#include "simulator/inertial/navigation.h"
#include "simulator/vehicle/quadrotor_model.h"
#include "simulator/vehicle/vehicle.h"

namespace tern {

/// The vehicle, the wind and the estimator.
struct QuadrotorFlight {
  QuadrotorConfig quadrotor;
  WindSpec wind;
  EstimatorSpec estimator;
};

/// The inputs of a vehicle that flies on the estimate of tern-estimator.
struct NavigationSetup {
  ImuSpec imu;
  StereoSpec camera;
  double max_sigma_m = 2.0;
};

/// Follows the commanded motion (executor/commanded_motion.h) as well as its controller can. Its only limits are
/// physical. The ground is the floor of the flight box.
///
/// With navigation, controller and UAV_STATE have its estimate from the first setpoint on that moves. Until then the
/// vehicle rests at its start, as on its legs. VEHICLE_STATUS reports the trouble of the navigation. Its
/// `position_sigma` is the drift of one second: things that were seen are misplaced by that
/// (docs/decisions/margins-of-an-estimate.md).
class QuadrotorVehicle final : public Vehicle {
 public:
  QuadrotorVehicle(const UavSpec& uav, const QuadrotorFlight& flight, std::uint64_t seed, UTime now,
                   const std::optional<NavigationSetup>& navigation = {});

  void receive(const UavState& setpoint) override { command_.receive(setpoint); }
  void receive(const TimedSpline& committed) override { command_.receive(committed); }
  void receive(const Plan& plan) override { command_.receive(plan); }
  void advance(UTime now) override;
  [[nodiscard]] const MotionHistory& truth() const override { return truth_; }
  [[nodiscard]] UavState true_state() const override;
  [[nodiscard]] Eigen::Quaterniond attitude() const override { return model_.truth().q; }
  [[nodiscard]] UavState estimate(UTime now) override;
  [[nodiscard]] VehicleStatus status(UTime now) const override;
  [[nodiscard]] Limits judged_limits() const override;
  [[nodiscard]] Navigation* navigation() override { return navigation_ ? &*navigation_ : nullptr; }

 private:
  void navigate();
  EstimatorSpec estimator_;
  Duration lead_;
  QuadrotorModel model_;
  CommandedMotion command_;
  MotionHistory truth_;
  MotionSample newest_;  ///< at truth_.end()
  UavState published_;
  std::optional<Navigation> navigation_;
};

}  // namespace tern
