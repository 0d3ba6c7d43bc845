#include "simulator/vehicle/quadrotor_vehicle.h"

#include <cmath>
#include <limits>

#include "core/base/digest.h"

namespace tern {
namespace {

/// Length of a piece of the truth: cubics through the model's states then deviate by less than a micrometre.
constexpr Duration kPiece{5'000};
constexpr Duration kRemembered{4'000'000};
static_assert(kPiece == Navigation::kImuStep);

InertialState inertial_state(const VehicleTruth& truth) {
  return {truth.q.toRotationMatrix(), truth.motion.p, truth.motion.v};
}

}  // namespace

QuadrotorVehicle::QuadrotorVehicle(const UavSpec& uav, const QuadrotorFlight& flight, std::uint64_t seed, UTime now,
                                   const std::optional<NavigationSetup>& navigation)
    : estimator_(flight.estimator),
      lead_(Duration::from_seconds(flight.quadrotor.controller.lead_s)),
      model_(flight.quadrotor, flight.wind, flight.estimator, seed, uav.start, uav.flight_box.min().z(), now),
      command_(uav.start, now, uav.limits),
      truth_(uav.start, now),
      newest_{.p = uav.start} {
  published_.at = now;
  published_.motion.p = uav.start;
  if (navigation) {
    navigation_.emplace(navigation->imu, navigation->camera, navigation->max_sigma_m, digest("navigation", seed),
                        inertial_state(model_.truth()), now);
    model_.set_held(true);
  }
}

void QuadrotorVehicle::navigate() {
  const VehicleTruth truth = model_.truth();
  navigation_->advance(inertial_state(truth), truth.w);
  const auto believed = navigation_->believed();
  if (!believed || model_.is_held()) return;
  const Eigen::Quaterniond turned(Mat3(believed->R * truth.q.toRotationMatrix().transpose()));
  model_.set_estimate_error(
      NavigationError{believed->p - truth.motion.p, believed->v - truth.motion.v, turned.normalized()});
}

void QuadrotorVehicle::advance(UTime now) {
  command_.settle(now - kSetpointSilence);
  while (truth_.end() + kPiece <= now) {
    const UTime end = truth_.end() + kPiece;
    for (UTime t = truth_.end(); t < end; t = t + kVehicleStep) {
      UavState command;
      command.at = t;
      command.motion = command_.sample(t);
      // The controller extrapolates the acceleration by the jerk. With the mean jerk it gets the exact later
      // acceleration.
      if (lead_ > Duration{}) {
        command.motion.j = (command_.acceleration_ahead(t, lead_) - command.motion.a) / lead_.seconds();
      }
      command.yaw = command_.yaw();
      if (!command.motion.v.isZero(0.0)) model_.set_held(false);
      model_.command(command);
      model_.advance(t + kVehicleStep);
    }
    const MotionSample reached = model_.truth().motion;
    truth_.append(hermite_piece(newest_, reached, kPiece));
    newest_ = reached;
    if (navigation_) navigate();
  }
  command_.forget_before(now - kRemembered);
  truth_.forget_before(now - kRemembered);
}

UavState QuadrotorVehicle::true_state() const {
  UavState state = model_.estimate();
  state.at = truth_.end();
  state.motion = newest_;
  if (navigation_) {  // the model's estimate has the believed heading
    const Vec3 ahead = model_.truth().q * Vec3::UnitX();
    state.yaw = std::atan2(ahead.y(), ahead.x());
  }
  return state;
}

UavState QuadrotorVehicle::estimate(UTime) {
  if (const auto estimate = model_.delayed_estimate()) published_ = *estimate;
  return published_;
}

VehicleStatus QuadrotorVehicle::status(UTime now) const {
  VehicleStatus status;
  status.at = now;
  status.armed = status.following = true;
  status.mode = "quadrotor";
  status.position_sigma = Vec3::Constant(std::hypot(estimator_.position_sigma_m, estimator_.drift_m));
  status.resets = model_.resets();
  if (navigation_) {
    status.position_sigma = navigation_->drift_sigma();
    status.estimator = navigation_->health();
    status.why_not = navigation_->trouble();
    status.following = status.why_not.empty();
  }
  return status;
}

Limits QuadrotorVehicle::judged_limits() const {
  const Vec3 none = Vec3::Constant(std::numeric_limits<double>::infinity());
  return {none, none, none};
}

}  // namespace tern
