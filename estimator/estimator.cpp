#include "estimator/estimator.h"

#include <algorithm>

#include "estimator/estimator_state.h"
#include "estimator/filter/motion.h"
#include "estimator/filter/rotation.h"

namespace tern {
namespace {

/// Without a frame for this long the vehicle is blind, and without a feature that could be used for kUnusedAfter: a
/// track is used when it spans all clones, up to 1.1 s at 10 Hz.
constexpr Duration kBlindAfter{300'000}, kUnusedAfter{1'500'000};
constexpr Duration kDriftAge{1'000'000};

/// The clone whose time is nearest to kDriftAge before `now`; −1 if there is none.
int drift_clone(const std::vector<Clone>& clones, UTime now) {
  int best = -1;
  std::int64_t least = 0;
  for (int k = 0; k < static_cast<int>(clones.size()); ++k) {
    const std::int64_t off = std::abs((now - clones[idx(k)].at - kDriftAge).us);
    if (best >= 0 && off >= least) continue;
    best = k;
    least = off;
  }
  return best;
}

/// The covariance of the displacement at p of things that were placed by the clone: [−[p]× 1] (ξ_now − ξ_clone).
Eigen::Matrix3d drift_of(const Msckf& filter, const AheadState& ahead, std::size_t clone) {
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  const Eigen::Index at = Msckf::column(clone);
  const Matrix6 cross = (ahead.Phi * filter.covariance().block<kNavErrors, 6>(0, at)).topRows<6>();
  const Matrix6 P = ahead.P.topLeftCorner<6, 6>() + filter.covariance().block<6, 6>(at, at) - cross - cross.transpose();
  Eigen::Matrix<double, 3, 6> J;
  J << -skew(ahead.nav.p), Eigen::Matrix3d::Identity();
  return J * P * J.transpose();
}

}  // namespace

std::optional<Estimate> Estimator::State::estimate() const {
  if (!newest || status.phase == EstimatorPhase::Waiting || status.phase == EstimatorPhase::Lost) return std::nullopt;
  const bool at_rest = status.phase == EstimatorPhase::AtRest;
  AheadState now = ahead;
  if (at_rest) std::tie(now.nav, now.P) = state_at_rest(rest.mean(), config, place);
  Estimate out;
  out.at = newest->at;
  out.T_WO = T_WO;
  out.pose = T_WO.to_O(PoseInW{now.nav.R, now.nav.p});
  out.velocity = T_WO.to_O(VectorInW{now.nav.v});
  const Vec3 g(0.0, 0.0, -config.gravity);
  if (!at_rest) {
    out.rate = newest->angular_velocity - now.nav.gyro_bias;
    out.acceleration = T_WO.to_O(VectorInW{now.nav.R * (newest->specific_force - now.nav.accel_bias) + g});
  }
  out.gyro_bias = now.nav.gyro_bias;
  out.accel_bias = now.nav.accel_bias;
  const NavMatrix J = ordinary_error_jacobian(now.nav);
  out.covariance = J * now.P * J.transpose();
  Eigen::Matrix<double, 3, kNavErrors> of_acceleration = Eigen::Matrix<double, 3, kNavErrors>::Zero();
  of_acceleration.middleCols<3>(kTheta) = skew(g);
  of_acceleration.middleCols<3>(kErrorBa) = -now.nav.R;
  out.acceleration_covariance = of_acceleration * now.P * of_acceleration.transpose();
  if (at_rest) return out;
  if (const int clone = drift_clone(filter->clones(), newest->at); clone >= 0) {
    out.drift_covariance = drift_of(*filter, now, idx(clone));
    out.drift_age = newest->at - filter->clones()[idx(clone)].at;
  }
  out.tracks = tracked;
  out.rejected = counts.refused;
  out.since_frame = newest->at - seen_at;
  const bool blind = out.since_frame > kBlindAfter || newest->at - used_at > kUnusedAfter;
  out.state = blind ? EstimatorState::Blind : EstimatorState::Tracking;
  return out;
}

Estimator::Estimator(const EstimatorConfig& config, const RestPlace& rest)
    : state_(std::make_unique<State>(config, rest)) {}
Estimator::~Estimator() = default;
Estimator::Estimator(const Estimator& other) : state_(std::make_unique<State>(*other.state_)) {}
Estimator::Estimator(Estimator&& other) noexcept = default;
Estimator& Estimator::operator=(Estimator&& other) noexcept = default;

void Estimator::start(const StartState& start) {
  const EstimatorStatus before = state_->status;
  state_ = std::make_unique<State>(state_->config, state_->place);
  state_->status = before;
  const auto [state, P] = known_state(start);
  state_->begin(state, P, start.at);
}

InputOutcome Estimator::add(const ImuSample& sample, const ImuRange& range) { return state_->add(sample, range); }
InputOutcome Estimator::add(const FeatureFrame& frame, const Masks& masks) { return state_->add(frame, masks); }
InputOutcome Estimator::add(const PositionFix& fix) { return state_->add(fix); }
std::optional<Estimate> Estimator::estimate() const { return state_->estimate(); }
const EstimatorStatus& Estimator::status() const { return state_->status; }

Odometry to_odometry(const Estimate& estimate) {
  Odometry out;
  out.at = estimate.at;
  out.state = estimate.state;
  out.epoch = estimate.T_WO.epoch;
  out.p_OB = estimate.pose.p;
  const Eigen::Quaterniond q = Eigen::Quaterniond(estimate.pose.R).normalized();
  out.q_OB = {q.w(), q.x(), q.y(), q.z()};
  out.v_OB = estimate.velocity.xyz;
  out.angular_velocity = estimate.rate;
  out.p_WO = estimate.T_WO.translation;
  out.yaw_WO = estimate.T_WO.yaw;
  out.gyroscope_bias = estimate.gyro_bias;
  out.accelerometer_bias = estimate.accel_bias;
  // The message has the position first, the estimate the attitude.
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 6; ++column) {
      out.pose_covariance[idx(6 * row + column)] = estimate.covariance((row + 3) % 6, (column + 3) % 6);
    }
  }
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      out.velocity_covariance[idx(3 * row + column)] =
          estimate.covariance(kVelocityError + row, kVelocityError + column);
      out.drift_covariance[idx(3 * row + column)] = estimate.drift_covariance(row, column);
    }
  }
  out.tracks = estimate.tracks;
  out.rejected = estimate.rejected;
  return out;
}

}  // namespace tern
