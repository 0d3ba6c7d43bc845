#include "estimator/filter/rest.h"

#include <cmath>

namespace tern {
namespace {

using Eigen::Matrix3d;

constexpr double kSigmas = 5.0;           ///< false alarm about once in 10 hours
constexpr double kForceFloor = 0.02;      ///< m/s²: idling motors
constexpr double kRateFloor = 2e-3;       ///< rad/s
constexpr double kMaxRestRate = 0.1;      ///< rad/s: no gyroscope in use has a larger bias
constexpr double kMaxGravityError = 1.0;  ///< m/s²: no accelerometer in use has a larger bias
constexpr double kRestVelocity = 0.02;    ///< m/s: what a motion reaches before it is noticed

/// The covariance of the right-invariant error from that of (φ, δp, δv, b̃_g, b̃_a).
NavMatrix invariant_covariance(const NavState& state, const NavMatrix& ordinary) {
  // The inverse of ordinary_error_jacobian: its off-diagonal blocks change sign.
  const NavMatrix J = 2.0 * NavMatrix::Identity() - ordinary_error_jacobian(state);
  return J * ordinary * J.transpose();
}

}  // namespace

void RestMeter::Block::add(const Block& other) {
  rate += other.rate;
  force += other.force;
  duration += other.duration;
  end = other.end;
}

bool RestMeter::is_still(const Block& block) const {
  const Vec3 rate = block.rate / block.duration, force = block.force / block.duration;
  if (rate.cwiseAbs().maxCoeff() > kMaxRestRate) return false;
  if (std::abs(force.norm() - gravity_) > kMaxGravityError) return false;
  Block before = rest_;
  for (const Block& young : young_) before.add(young);
  if (before.duration <= 0.0) return true;
  const double spread = kSigmas * std::sqrt(1.0 / block.duration + 1.0 / before.duration);
  const Vec3 turned = rate - before.rate / before.duration, pushed = force - before.force / before.duration;
  return turned.cwiseAbs().maxCoeff() <= spread * noise_.gyro + kRateFloor &&
         pushed.cwiseAbs().maxCoeff() <= spread * noise_.accel + kForceFloor;
}

bool RestMeter::add(const ImuStep& step, UTime end) {
  current_.add({step.rate * step.h, step.force * step.h, step.h, end});
  if (current_.duration < kBlock) return true;
  const Block block = std::exchange(current_, Block{});
  if (!is_still(block)) return false;
  young_.push_back(block);
  if (young_.size() <= idx(kYoungBlocks)) return true;
  rest_.add(young_.front());
  young_.pop_front();
  end_ = rest_.end;
  if (rest_.duration > kRestMemory) {
    const double keep = kRestMemory / rest_.duration;
    rest_.rate *= keep;
    rest_.force *= keep;
    rest_.duration = kRestMemory;
  }
  return true;
}

RestMean RestMeter::mean() const {
  if (rest_.duration <= 0.0) return {};
  return {rest_.rate / rest_.duration, rest_.force / rest_.duration, rest_.duration};
}

void RestMeter::restart() {
  rest_ = current_ = Block{};
  young_.clear();
}

std::pair<NavState, NavMatrix> state_at_rest(const RestMean& mean, const EstimatorConfig& config,
                                             const RestPlace& place) {
  NavState state;
  state.R = Eigen::Quaterniond::FromTwoVectors(mean.force, Vec3::UnitZ()).toRotationMatrix();
  const double yaw = std::atan2(state.R(1, 0), state.R(0, 0));
  state.R = Eigen::AngleAxisd(place.yaw - yaw, Vec3::UnitZ()).toRotationMatrix() * state.R;
  state.p = place.position.xyz;
  state.gyro_bias = mean.rate;

  const double g = config.gravity, T = mean.duration, noise = config.noise.accel * config.noise.accel / T;
  const double prior = config.accel_bias_deviation * config.accel_bias_deviation;
  state.accel_bias = state.R.transpose() * Vec3(0.0, 0.0, (mean.force.norm() - g) * prior / (prior + noise));

  // In W's axes: b' = R̂ b̃_a, of which the tilt follows; then back to B.
  Matrix3d tilt;  // θ = tilt · (b' + noise of the mean)
  tilt << 0.0, -1.0 / g, 0.0, 1.0 / g, 0.0, 0.0, 0.0, 0.0, 0.0;
  const Matrix3d bias = Vec3(prior, prior, prior * noise / (prior + noise)).asDiagonal();
  NavMatrix P = NavMatrix::Zero();
  P.block<3, 3>(kTheta, kTheta) = tilt * (bias + noise * Matrix3d::Identity()) * tilt.transpose();
  P(kTheta + 2, kTheta + 2) = config.start_yaw_deviation * config.start_yaw_deviation;
  P.block<3, 3>(kTheta, kErrorBa) = tilt * bias * state.R;
  P.block<3, 3>(kErrorBa, kTheta) = P.block<3, 3>(kTheta, kErrorBa).transpose();
  P.block<3, 3>(kErrorBa, kErrorBa) = state.R.transpose() * bias * state.R;
  P.diagonal().segment<3>(kErrorP).setConstant(config.start_deviation * config.start_deviation);
  P.diagonal().segment<3>(kErrorV).setConstant(kRestVelocity * kRestVelocity);
  const double gyro = config.noise.gyro, walk = config.noise.gyro_walk;
  P.diagonal().segment<3>(kErrorBg).setConstant(gyro * gyro / T + walk * walk * T / 3.0);
  return {state, invariant_covariance(state, P)};
}

std::pair<NavState, NavMatrix> known_state(const StartState& start) {
  const NavState state{start.pose.R, start.pose.p, start.velocity.xyz, start.gyro_bias, start.accel_bias};
  NavVector deviation;
  deviation << Vec3::Constant(start.attitude_deviation), Vec3::Constant(start.position_deviation),
      Vec3::Constant(start.velocity_deviation), Vec3::Constant(start.gyro_bias_deviation),
      Vec3::Constant(start.accel_bias_deviation);
  return {state, invariant_covariance(state, NavMatrix(deviation.cwiseAbs2().asDiagonal()))};
}

}  // namespace tern
