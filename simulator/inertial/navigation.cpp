#include "simulator/inertial/navigation.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace tern {
namespace {

OdometryOffset offset_of(const Odometry& odometry) { return {odometry.p_WO, odometry.yaw_WO, odometry.epoch}; }

Duration whole_steps(double rate_hz) {
  const auto steps = std::llround(1e6 / rate_hz / static_cast<double>(Navigation::kImuStep.us));
  return Navigation::kImuStep * std::max<std::int64_t>(steps, 1);
}

}  // namespace

Navigation::Navigation(const ImuSpec& imu, const StereoSpec& camera, double max_sigma_m, std::uint64_t seed,
                       const InertialState& start, UTime now)
    : imu_(imu, seed),
      frame_period_(whole_steps(camera.rate_hz)),
      max_sigma_m_(max_sigma_m),
      begun_(now),
      now_(now),
      truth_(start) {}

void Navigation::advance(const InertialState& truth, const Vec3& rate) {
  const double h = kImuStep.seconds();
  now_ = now_ + kImuStep;
  const Measured measured{now_, imu_.measure(sample_between(truth_, truth, h), h)};
  truth_ = truth;
  samples_.push_back({now_, measured.sample.rate, measured.sample.force});
  since_odometry_.push_back(measured);
  if ((now_ - begun_).us % frame_period_.us == 0) exposures_.push_back({now_, truth, rate});
  if (!odometry_) {
    while (now_ - since_odometry_.front().at > kRemembered) since_odometry_.pop_front();
    return;
  }
  integrate(measured, h);
  follow_offset(h);
  const InertialState believed = *this->believed();
  Belief belief;
  belief.R = believed.R * truth.R.transpose();
  belief.p = believed.p - belief.R * truth.p;
  beliefs_.emplace_back(now_, belief);
  while (now_ - beliefs_.front().first > kRemembered) beliefs_.pop_front();
}

void Navigation::integrate(const Measured& measured, double h_s) {
  InertialSample sample = measured.sample;
  sample.rate -= odometry_->gyroscope_bias;
  sample.force -= odometry_->accelerometer_bias;
  odometry_state_ = strapdown(odometry_state_, sample, h_s);
}

void Navigation::follow_offset(double h_s) {
  const OdometryOffset aim = offset_of(*odometry_);
  if (!offset_) offset_ = aim;
  const double moves = outstanding(), most = kCorrectionSpeed * h_s;
  if (moves <= most) {
    offset_ = aim;
    return;
  }
  offset_->translation += most / moves * (aim.translation - offset_->translation);
  offset_->yaw += most / moves * std::remainder(aim.yaw - offset_->yaw, 2.0 * std::numbers::pi);
}

bool Navigation::is_valid() const {
  return odometry_ && (odometry_->state == EstimatorState::Tracking || odometry_->state == EstimatorState::Blind);
}

void Navigation::receive(const Odometry& odometry) {
  const bool is_valid = odometry.state == EstimatorState::Tracking || odometry.state == EstimatorState::Blind;
  if (odometry.at > now_ || (odometry_ && odometry.at < odometry_->at)) return;
  if (!is_valid) {  // its pose is not used: the last one is carried on
    if (odometry_) odometry_->state = odometry.state;
    return;
  }
  odometry_ = odometry;
  const Eigen::Vector4d& q = odometry.q_OB;
  odometry_state_ = {Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix(), odometry.p_OB,
                     odometry.v_OB};
  while (!since_odometry_.empty() && since_odometry_.front().at <= odometry.at) since_odometry_.pop_front();
  UTime from = odometry.at;
  for (const Measured& measured : since_odometry_) {
    integrate(measured, (measured.at - from).seconds());
    from = measured.at;
  }
  if (!offset_) offset_ = offset_of(odometry);
}

std::vector<ImuSample> Navigation::take_samples() { return std::exchange(samples_, {}); }

std::vector<StereoExposure> Navigation::take_exposures() { return std::exchange(exposures_, {}); }

std::optional<InertialState> Navigation::believed() const {
  if (!odometry_) return std::nullopt;
  const PoseInW pose = offset_->to_W(PoseInO{odometry_state_.R, odometry_state_.p});
  return InertialState{pose.R, pose.p, offset_->to_W(VectorInO{odometry_state_.v}).xyz};
}

Belief Navigation::belief_at(UTime t) const {
  if (beliefs_.empty()) return {};
  const auto later =
      std::find_if(beliefs_.begin(), beliefs_.end(), [t](const auto& entry) { return entry.first >= t; });
  return later == beliefs_.end() ? beliefs_.back().second : later->second;
}

double Navigation::outstanding() const {
  if (!odometry_) return 0.0;
  const PointInO here{odometry_state_.p};
  return (offset_of(*odometry_).to_W(here).xyz - offset_->to_W(here).xyz).norm();
}

Vec3 Navigation::drift_sigma() const {
  if (!odometry_) return Vec3::Zero();
  const auto& c = odometry_->drift_covariance;
  return Vec3(c[0], c[4], c[8]).cwiseMax(0.0).cwiseSqrt();
}

double Navigation::position_sigma() const {
  if (!odometry_) return 0.0;
  Mat3 covariance;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      covariance(row, column) = odometry_->pose_covariance[idx(6 * row + column)];
  }
  const double largest = Eigen::SelfAdjointEigenSolver<Mat3>(covariance, Eigen::EigenvaluesOnly).eigenvalues()[2];
  return std::sqrt(std::max(largest, 0.0));
}

std::string Navigation::trouble() const {
  if (!odometry_) return "no estimate yet: tern-estimator waits for the vehicle to rest, or does not run";
  if (odometry_->state == EstimatorState::Lost) return "tern-estimator is lost";
  if (!is_valid()) return "tern-estimator has started anew";
  if (now_ - odometry_->at > kMaxAge) {
    return fmt::format("ODOMETRY is {:.1f} s old: is tern-estimator alive?", (now_ - odometry_->at).seconds());
  }
  const double sigma = position_sigma();
  if (sigma > max_sigma_m_) {
    return fmt::format("the position's standard deviation is {:.2f} m, above simulator.vio.max_sigma_m ({:g} m)", sigma,
                       max_sigma_m_);
  }
  return "";
}

EstimatorHealth Navigation::health() const {
  if (!trouble().empty()) return EstimatorHealth::Lost;
  return odometry_->state == EstimatorState::Blind ? EstimatorHealth::Degraded : EstimatorHealth::Good;
}

}  // namespace tern
