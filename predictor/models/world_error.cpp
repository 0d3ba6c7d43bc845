#include "predictor/models/world_error.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/world/frames.h"

namespace tern {

void WorldError::add(const Odometry& odometry) {
  if (odometry.state != EstimatorState::Tracking && odometry.state != EstimatorState::Blind) return;
  odometry_ = odometry;
  const OdometryOffset offset{odometry.p_WO, odometry.yaw_WO, odometry.epoch};
  position_ = offset.to_W(PointInO{odometry.p_OB}).xyz;
  velocity_ = offset.to_W(VectorInO{odometry.v_OB}).xyz;
}

void WorldError::add_vehicle(const Vec3& p, UTime at) {
  if (!odometry_ || is_stale(at)) return;
  apart_ = (p - position_ - (at - odometry_->at).seconds() * velocity_).norm();
}

double WorldError::margin(const Vec3& x) const {
  if (!odometry_) return 0.0;
  const Eigen::Matrix<double, 6, 6> pose =
      Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(odometry_->pose_covariance.data());
  const Vec3 r = x - position_;
  Eigen::Matrix<double, 3, 6> J;
  J << 1.0, 0.0, 0.0, 0.0, r.z(), -r.y(),  //
      0.0, 1.0, 0.0, -r.z(), 0.0, r.x(),   //
      0.0, 0.0, 1.0, r.y(), -r.x(), 0.0;
  const Eigen::Matrix3d at_x = J * pose * J.transpose();
  const double largest = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(at_x, Eigen::EigenvaluesOnly).eigenvalues()[2];
  const double width = kQuantile * std::sqrt(std::max(largest, 0.0)) + apart_;
  return std::ceil(width / kStep) * kStep;
}

double WorldError::drift(UTime at) const {
  if (!is_stale(at)) return 0.0;
  const double drift = kDriftSpeed * (at - odometry_->at - kFresh).seconds();
  return std::min(kMostDrift, std::ceil(drift / kStep) * kStep);
}

void WorldError::widen(std::vector<Track>& tracks, UTime at) const {
  if (!odometry_) return;
  for (Track& track : tracks) {
    const double by = margin(track.motion.sample(at).p) + drift(at);
    for (Vec3& alpha : track.alpha) alpha += Vec3::Constant(by);
  }
}

}  // namespace tern
