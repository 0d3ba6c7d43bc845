#include "mavlink/odometry_report.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/world/estimate_jump.h"
#include "core/world/stated_bound.h"
#include "mavlink/axes.h"

namespace tern::mavlink {
namespace {

/// MAV_FRAME.
constexpr std::uint8_t kLocalNed = 1, kBodyNed = 8, kBodyFrd = 12, kLocalFrd = 20;
/// A covariance in floats may miss semidefiniteness by this share of its largest eigenvalue.
constexpr double kRounding = 1e-4;

using Matrix = Eigen::Matrix3d;

template <class Range>
bool is_finite(const Range& values) {
  return std::all_of(values.begin(), values.end(), [](float x) { return std::isfinite(x); });
}

/// The matrix whose upper right triangle the message has, row by row.
PoseCovariance symmetric(const std::array<float, 21>& triangle) {
  PoseCovariance whole;
  std::size_t at = 0;
  for (int row = 0; row < 6; ++row) {
    for (int column = row; column < 6; ++column) whole(row, column) = whole(column, row) = triangle[at++];
  }
  return whole;
}

bool is_in_body(const Odometry& m) { return m.child_frame_id == kBodyFrd || m.child_frame_id == kBodyNed; }
bool is_in_local(const Odometry& m) { return m.child_frame_id == kLocalNed || m.child_frame_id == kLocalFrd; }

bool is_variance(double x) { return std::isfinite(x) && x > 0.0; }

/// The map of NED vectors to ENU, and of FRD to FLU.
Matrix enu_ned() {
  Matrix S;
  S << 0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, -1.0;
  return S;
}

struct StatedVelocity {
  Matrix covariance;
  Vec3 variance;  ///< per axis of W
};

/// Returns the covariance of the velocity that a message states, W, (m/s)²; nullopt if it states none.
/// @param R  turns the velocity's frame to W
std::optional<StatedVelocity> stated_velocity(const Odometry& m, const Matrix& R, bool correlated) {
  const Matrix C = symmetric(m.velocity_covariance).topLeftCorner<3, 3>();
  const Vec3 diagonal = C.diagonal();
  if (!is_variance(diagonal.x()) || !is_variance(diagonal.y()) || !is_variance(diagonal.z())) return std::nullopt;
  const bool open = !C.allFinite();
  const Matrix in_W = R * (open ? Matrix(diagonal.asDiagonal()) : C) * R.transpose();
  if (!open || !correlated) return StatedVelocity{in_W, in_W.diagonal()};
  const Vec3 most = Vec3::Constant(diagonal.sum());  // of any direction, as for a pose
  return StatedVelocity{most.asDiagonal(), is_in_local(m) ? Vec3(in_W.diagonal()) : most};
}

template <std::size_t n, class M>
void write(std::array<double, n>& rows, const M& matrix) {
  for (int row = 0; row < matrix.rows(); ++row) {
    for (int column = 0; column < matrix.cols(); ++column)
      rows[idx(row * matrix.cols() + column)] = matrix(row, column);
  }
}

}  // namespace

Result<StatedPose> stated_pose(const Odometry& m, const OdometryAssumptions& assumed) {
  PoseCovariance ned = symmetric(m.pose_covariance);
  const bool is_open = std::isnan(m.pose_covariance[0]);  // by the message's definition, all of it
  for (int k = 0; k < 6; ++k) {
    if (is_variance(ned(k, k)) && !is_open) continue;
    const double sigma = k < 3 ? assumed.sigma_m : assumed.sigma_rad;
    if (sigma <= 0.0) {
      return fail(
          fmt::format("it does not state how wrong its {} is (pose_covariance is {}); mavlink.{} would assume it",
                      k < 3 ? "position" : "rotation", is_open ? std::nan("") : ned(k, k),
                      k < 3 ? "odometry_sigma_m" : "odometry_sigma_deg"));
    }
    ned(k, k) = sigma * sigma;
  }
  const Vec3 position = enu_ned().cwiseAbs() * ned.diagonal().head<3>();
  if (!ned.allFinite()) {
    Eigen::Matrix<double, 6, 1> variances = ned.diagonal();
    const double rotation = variances.tail<3>().sum();
    if (assumed.correlated) variances.head<3>().setConstant(2.0 * variances.head<3>().sum());
    variances.tail<3>().setConstant((assumed.correlated ? 2.0 : 1.0) * rotation);
    ned = PoseCovariance(variances.asDiagonal());
  }
  const auto eigenvalues = Eigen::SelfAdjointEigenSolver<PoseCovariance>(ned, Eigen::EigenvaluesOnly).eigenvalues();
  if (!(eigenvalues[0] >= -kRounding * eigenvalues[5])) return fail("its pose_covariance is not a covariance");
  PoseCovariance S = PoseCovariance::Zero();
  S.topLeftCorner<3, 3>() = S.bottomRightCorner<3, 3>() = enu_ned();
  return StatedPose{S * ned * S.transpose(), position};
}

void OdometryReport::add(const Odometry& m, UTime at) {
  if (newest_ && at <= newest_->at) return;
  states_quality_ = states_quality_ || m.quality > 0;
  if (m.quality < 0 || (m.quality == 0 && states_quality_)) {
    refused_ = fmt::format("its estimator has failed (quality {})", m.quality);
    if (newest_) newest_->at = at, newest_->state = EstimatorState::Lost;
    return;
  }
  refused_ = refusal(m);
  if (!refused_.empty()) return;
  const auto stated = stated_pose(m, assumed_);
  if (stated) return use(m, at, *stated);
  refused_ = stated.error().message;
}

std::string OdometryReport::refusal(const Odometry& m) {
  if ((m.frame_id != kLocalNed && m.frame_id != kLocalFrd) || !(is_in_body(m) || is_in_local(m)))
    return fmt::format("its frames {} and {} are unknown (MAV_FRAME)", m.frame_id, m.child_frame_id);
  const bool is_unit = std::abs(quaternion_of(m.q).norm() - 1.0) < 0.1;
  return is_unit && is_finite(m.p) && is_finite(m.v) ? "" : "its pose or velocity is not finite";
}

bool OdometryReport::follow_resets(const Odometry& m, UTime at, const Vec3& p, const Vec3& v, double yaw) {
  const bool counted = reset_counter_ && *reset_counter_ != m.reset_counter;
  const bool jumped = newest_ && estimate_jumps(p_, v_, p, at - newest_->at);
  reset_counter_ = m.reset_counter;
  p_ = p;
  v_ = v;
  if (const auto jump = frame_.add(at, p, v, yaw, counted || jumped)) {
    offset_ = composed(*jump, offset_);
    ++offset_.epoch;
  }
  return counted || jumped;
}

void OdometryReport::use(const Odometry& m, UTime at, const StatedPose& stated) {
  const Matrix R_WB = swapped(quaternion_of(m.q).normalized()).toRotationMatrix();
  const Matrix R_WV = is_in_body(m) ? Matrix(R_WB * Vec3(1.0, -1.0, -1.0).asDiagonal()) : enu_ned();
  const Vec3 p = origin_ + enu_of(m.p), v = R_WV * Vec3(m.v[0], m.v[1], m.v[2]);
  const bool reset = follow_resets(m, at, p, v, std::atan2(R_WB(1, 0), R_WB(0, 0)));
  const auto velocity = stated_velocity(m, R_WV, assumed_.correlated);
  remember({at, stated.position_variance, Vec3::Zero(),
            velocity ? std::optional<Vec3>(velocity->variance) : std::nullopt, reset});
  tern::Odometry out;
  out.at = at;
  out.state = EstimatorState::Tracking;
  out.epoch = offset_.epoch;
  const PoseInO pose = offset_.to_O(PoseInW{R_WB, p});
  const Eigen::Quaterniond q_OB(pose.R);
  out.p_OB = pose.p;
  out.q_OB = {q_OB.w(), q_OB.x(), q_OB.y(), q_OB.z()};
  out.v_OB = offset_.to_O(VectorInW{v}).xyz;
  if (is_finite(m.rates)) out.angular_velocity = {m.rates[0], -m.rates[1], -m.rates[2]};
  out.p_WO = offset_.translation;
  out.yaw_WO = offset_.yaw;
  write(out.pose_covariance, stated.covariance);
  write(out.velocity_covariance, velocity ? velocity->covariance : Matrix(kUnknownVariance * Matrix::Identity()));
  write(out.drift_covariance, Matrix(drift().asDiagonal()));
  newest_ = out;
}

void OdometryReport::remember(const Stated& stated) {
  stated_.push_back(stated);
  if (stated_.size() > 1 && !stated.reset)
    stated_.back().taken_away = (stated_[stated_.size() - 2].position - stated.position).cwiseMax(0.0);
  while (stated.at - stated_.front().at > kDriftTime) stated_.pop_front();
}

Vec3 OdometryReport::drift() const {
  const double T = kDriftTime.seconds();
  Vec3 most = Vec3::Zero(), taken = Vec3::Zero(), velocity = Vec3::Zero();
  bool reset = false, knows_velocity = true;
  for (const Stated& stated : stated_) {
    most = most.cwiseMax(stated.position);
    taken += stated.taken_away;
    reset = reset || stated.reset;
    knows_velocity = knows_velocity && stated.velocity;
    if (stated.velocity) velocity += *stated.velocity / static_cast<double>(stated_.size());
  }
  const Vec3 apart = (reset ? 16.0 : 4.0) * most;
  return knows_velocity ? Vec3(apart.cwiseMin(2.0 * (T * T * velocity + taken))) : apart;
}

Vec3 OdometryReport::drift_sigma() const {
  if (!newest_) return Vec3::Zero();
  const auto& c = newest_->drift_covariance;
  return Vec3(c[0], c[4], c[8]).cwiseSqrt();
}

std::string OdometryReport::fault(UTime now) const {
  const bool is_fresh = newest_ && now - newest_->at <= kMaxAge && newest_->state == EstimatorState::Tracking;
  if (!refused_.empty() && !is_fresh) return "ODOMETRY is not used: " + refused_;
  if (!newest_) return "no ODOMETRY has come (mavlink.odometry)";
  if (now - newest_->at > kMaxAge)
    return fmt::format("ODOMETRY is {:.1f} s old: is its estimator alive?", (now - newest_->at).seconds());
  const double sigma = stated_bound(newest_->pose_covariance) / std::sqrt(kChiSquared3);
  if (sigma <= assumed_.max_sigma_m) return "";
  return fmt::format("the position's standard deviation is {:.2f} m, above mavlink.odometry_max_sigma_m ({:g} m)",
                     sigma, assumed_.max_sigma_m);
}

}  // namespace tern::mavlink
