#include "simulator/vehicle/quadrotor_model.h"

#include <algorithm>
#include <cmath>

namespace tern {
namespace {

/// Offsets that make the seeds of wind and estimator independent.
constexpr std::uint64_t kWindSeed = 0x9e3779b97f4a7c15ULL, kEstimatorSeed = 0xc2b2ae3d27d4eb4fULL;

/// Iterations of the trim. The drag changes little with the tilt: each iteration leaves a tenth of the error.
constexpr int kTrimSteps = 10;

double yaw_of(const Eigen::Quaterniond& q) {
  const Vec3 x = q * Vec3::UnitX();
  return std::atan2(x.y(), x.x());
}

}  // namespace

FlightControllerSpec QuadrotorConfig::controller_for(QuadrotorClass kind, const QuadrotorSpec& body) {
  FlightControllerSpec gains;
  if (kind == QuadrotorClass::Racer) {
    gains.tilt_max = 1.4;
    gains.rate_max = 20.0;
  }
  gains.drag_per_s = body.drag_per_s;
  gains.lead_s = 1.0 / gains.attitude_p;
  return gains;
}

QuadrotorModel::QuadrotorModel(const QuadrotorConfig& config, const WindSpec& wind, const EstimatorSpec& estimator,
                               std::uint64_t seed, const Vec3& start, double ground_z, UTime now)
    : config_(config),
      wind_(wind, seed ^ kWindSeed),
      estimator_(estimator, seed ^ kEstimatorSeed),
      latency_(Duration::from_seconds(estimator.latency_s)),
      controller_(config.body, config.controller),
      state_(start.z() > ground_z ? hovering(config.body, start, 0.0) : standing(config.body, start, 0.0)),
      ground_z_(ground_z),
      time_(now) {
  start_.motion.p = start;
  if (!state_.on_ground) trim_for_wind();
}

void QuadrotorModel::trim_for_wind() {
  const Vec3 mean = wind_.mean();
  Vec3 against = Vec3::Zero();
  for (int k = 0; k < kTrimSteps; ++k) {
    const Vec3 f = against + Vec3(0.0, 0.0, kGravity);
    state_.q = smallest_rotation(Vec3::UnitZ(), f);
    state_.thrust.fill(std::min(config_.body.mass_kg * f.norm() / 4.0, config_.body.max_thrust()));
    against -= acceleration(config_.body, state_, mean);
  }
  controller_.trim(against);
}

FlightCommand QuadrotorModel::commanded() const {
  const UavState& newest = command_ ? *command_ : start_;
  FlightCommand command;
  command.motion = newest.motion;
  command.yaw = newest.yaw;
  if (!command_) return command;
  const double t = std::clamp(time_ - newest.at, Duration{}, kHeldFor).seconds();
  MotionSample& m = command.motion;
  m.p += t * (m.v + t * (m.a / 2.0 + t * m.j / 6.0));
  m.v += t * (m.a + t * m.j / 2.0);
  m.a += t * m.j;
  if (time_ - newest.at > kHeldFor) m.v = m.a = m.j = Vec3::Zero();
  return command;
}

FlightEstimate QuadrotorModel::believed() const {
  FlightEstimate e;
  e.p = state_.p + estimator_.position_error();
  e.v = state_.v + estimator_.velocity_error();
  e.a = acceleration(config_.body, state_, wind_.velocity());
  e.q = state_.q;
  e.w = state_.w;
  if (other_error_) {
    e.p += other_error_->position;
    e.v += other_error_->velocity;
    e.q = other_error_->attitude * e.q;
  }
  return e;
}

void QuadrotorModel::move_body(const Vec3& air) {
  const double dt = kVehicleStep.seconds();
  Rotors rotors;
  rotors.fill(config_.body.least_thrust * config_.body.max_thrust());
  if (armed_) {
    rotors = controller_.update(commanded(), believed(), dt);
  } else {
    controller_.reset();
  }
  state_ = step(config_.body, state_, rotors, air, ground_z_, dt);
}

void QuadrotorModel::step_once() {
  const double dt = kVehicleStep.seconds();
  const Vec3 air = wind_.velocity();
  if (!held_) move_body(air);
  wind_.advance((state_.v - air).norm(), dt);
  estimator_.advance(dt);
  time_ = time_ + kVehicleStep;
}

void QuadrotorModel::advance(UTime now) {
  while (time_ + kVehicleStep <= now) {
    step_once();
    if (latency_ > Duration{}) delayed_.push_back(estimate());
  }
}

VehicleTruth QuadrotorModel::truth() const {
  VehicleTruth truth;
  truth.at = time_;
  truth.motion.p = state_.p;
  truth.motion.v = state_.v;
  if (!state_.on_ground && !held_) truth.motion.a = acceleration(config_.body, state_, wind_.velocity());
  truth.q = state_.q;
  truth.w = state_.w;
  truth.on_ground = state_.on_ground;
  return truth;
}

UavState QuadrotorModel::estimate() const {
  const FlightEstimate believed_now = believed();
  UavState state;
  state.at = time_;
  state.motion.p = believed_now.p;
  state.motion.v = believed_now.v;
  state.motion.a = truth().motion.a;
  state.yaw = yaw_of(believed_now.q);
  return state;
}

std::optional<UavState> QuadrotorModel::delayed_estimate() {
  if (latency_ <= Duration{}) return estimate();
  while (delayed_.size() > 1 && delayed_[1].at <= time_ - latency_) delayed_.pop_front();
  if (delayed_.empty() || delayed_.front().at > time_ - latency_) return std::nullopt;
  return delayed_.front();
}

}  // namespace tern
