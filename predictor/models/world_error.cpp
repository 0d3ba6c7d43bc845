#include "predictor/models/world_error.h"

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

double WorldError::drift(UTime at) const {
  if (!is_stale(at)) return 0.0;
  const double drift = kDriftSpeed * (at - odometry_->at - kFresh).seconds();
  return std::min(kMostDrift, std::ceil(drift / PoseError::kStep) * PoseError::kStep);
}

PoseError WorldError::pose_error(UTime at) const {
  PoseError error;
  error.position = position_;
  error.pose_covariance = odometry_->pose_covariance;
  error.apart = apart_ + drift(at);
  return error;
}

void widen(std::vector<Track>& tracks, const PoseError& error, UTime at) {
  for (Track& track : tracks) {
    const double by = error.margin(track.motion.sample(at).p);
    for (Vec3& alpha : track.alpha) alpha += Vec3::Constant(by);
  }
}

}  // namespace tern
