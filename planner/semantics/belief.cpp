#include "planner/semantics/belief.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/world/thrust.h"

namespace tern {
namespace {

using Mat3d = Eigen::Matrix3d;

Mat3d cross(const Vec3& x) {
  Mat3d X;
  X << 0.0, -x.z(), x.y(), x.z(), 0.0, -x.x(), -x.y(), x.x(), 0.0;
  return X;
}

}  // namespace

Belief15::Belief15(const InertialNoise& noise) : noise_(noise) {
  const double b2 = noise.force_bias * noise.force_bias;
  P_.block<3, 3>(9, 9).diagonal().setConstant(b2);
  P_.block<3, 3>(12, 12).diagonal().setConstant(noise.rate_bias * noise.rate_bias);
  P_(6, 6) = P_(7, 7) = b2 / (kGravity * kGravity);
  P_(7, 9) = P_(9, 7) = b2 / kGravity;
  P_(6, 10) = P_(10, 6) = -b2 / kGravity;
}

void Belief15::move(double h, double heading, const Vec3& a) {
  const Mat3d R = Eigen::AngleAxisd(heading, Vec3::UnitZ()).toRotationMatrix();
  Covariance A = Covariance::Zero();
  A.block<3, 3>(0, 3).setIdentity();
  A.block<3, 3>(3, 6) = -cross(a + Vec3(0, 0, kGravity));
  A.block<3, 3>(3, 9) = -R;
  A.block<3, 3>(6, 12) = -R;
  const Covariance Phi = Covariance::Identity() + h * A + (0.5 * h * h) * A * A;
  Covariance Q = Covariance::Zero();
  Q.diagonal().segment<3>(3).setConstant(noise_.force * noise_.force * h);
  Q.diagonal().segment<3>(6).setConstant(noise_.rate * noise_.rate * h);
  Q.diagonal().segment<3>(9).setConstant(noise_.force_walk * noise_.force_walk * h);
  Q.diagonal().segment<3>(12).setConstant(noise_.rate_walk * noise_.rate_walk * h);
  // Half of the noise acts before the step and half after it: correct to second order.
  P_ = (Phi * (P_ + 0.5 * Q) * Phi.transpose() + 0.5 * Q).eval();
}

template <int Rows>
void Belief15::update(const Eigen::Matrix<double, Rows, 15>& H, double variance) {
  const Eigen::Matrix<double, 15, Rows> PHt = P_ * H.transpose();
  Eigen::Matrix<double, Rows, Rows> S = H * PHt;
  S.diagonal().array() += variance;
  P_ -= PHt * S.inverse() * PHt.transpose();
  P_ = (0.5 * (P_ + P_.transpose())).eval();
}

void Belief15::see(double h, const Sight& sight, double frame_s, const Vec3& v) {
  const double pairs = kTrackGain * kTrackGain / (frame_s * h);
  Eigen::Matrix<double, 3, 15> H = Eigen::Matrix<double, 3, 15>::Zero();
  H.block<3, 3>(0, 3).setIdentity();
  H.block<3, 3>(0, 6) = cross(v);
  update(H, pairs * sight.translation_m * sight.translation_m / 3.0);
  H.setZero();
  H.block<3, 3>(0, 12).setIdentity();
  update(H, pairs * sight.rotation_rad * sight.rotation_rad + noise_.rate * noise_.rate / h);
}

double Belief15::position_sigma() const { return std::sqrt(P_.topLeftCorner<3, 3>().trace()); }

ForetoldError foretell_error(const std::vector<Vec3>& path, double speed, const InformationMap& information) {
  double length = 0.0;
  for (std::size_t k = 1; k < path.size(); ++k) length += (path[k] - path[k - 1]).norm();
  Belief15 belief;
  ForetoldError foretold;
  std::size_t leg = 1;
  double s = 0.0, leg_begins = 0.0, v = 0.0;
  while (s < length && leg < path.size()) {
    double leg_length = (path[leg] - path[leg - 1]).norm();
    while (leg + 1 < path.size() && s > leg_begins + leg_length) {
      leg_begins += leg_length;
      ++leg;
      leg_length = (path[leg] - path[leg - 1]).norm();
    }
    const Vec3 way = (path[leg] - path[leg - 1]) / std::max(leg_length, 1e-12);
    const Vec3 p = path[leg - 1] + (s - leg_begins) * way;
    const double braking = std::sqrt(2.0 * kBeliefAcceleration * std::max(length - s, 0.01));
    const double next = std::min({speed, v + kBeliefAcceleration * kBeliefStep, braking});
    const Vec3 a = (next - v) / kBeliefStep * way;
    v = next;
    belief.move(kBeliefStep, std::atan2(way.y(), way.x()), a);
    belief.see(kBeliefStep, information.sight(p, way.x(), way.y()), information.frame_s(), v * way);
    foretold.at_goal = belief.position_sigma();
    foretold.at_worst = std::max(foretold.at_worst, foretold.at_goal);
    s += v * kBeliefStep;
  }
  return foretold;
}

}  // namespace tern
