#include "estimator/filter/position_fix.h"

#include <Eigen/Dense>
#include <cmath>
#include <numbers>
#include <optional>

#include "estimator/filter/rotation.h"

namespace tern {
namespace {

/// The drift of an estimate without fixes, as a share of its way.
constexpr double kDriftShare = 0.05;

using Eigen::Index;
using Eigen::Matrix3d;

/// A pose of the filter, and the first column of its error.
struct TimedPose {
  UTime at;
  Matrix3d R;
  Vec3 p, v;
  Index column;
};

/// The poses before and after a time; both are the same if the time is that of a pose.
struct Bracket {
  TimedPose before, after;
  double share = 0.0;  ///< of the way from before to after
};

std::optional<Bracket> bracket(const Msckf& filter, UTime filter_at, UTime at) {
  TimedPose after{filter_at, filter.nav().R, filter.nav().p, filter.nav().v, kTheta};
  for (std::size_t k = filter.clones().size(); after.at > at; --k) {
    if (k == 0) return std::nullopt;
    const Clone& clone = filter.clones()[k - 1];
    const TimedPose before{clone.at, clone.R, clone.p, clone.v, Msckf::column(k - 1)};
    if (before.at <= at) {
      const double span = (after.at - before.at).seconds();
      return Bracket{before, after, span > 0.0 ? (at - before.at).seconds() / span : 0.0};
    }
    after = before;
  }
  return Bracket{after, after, 0.0};
}

Vec3 position_between(const Bracket& b) {
  const double s = b.share, h = (b.after.at - b.before.at).seconds();
  const double to = s * s * (3.0 - 2.0 * s);
  return (1.0 - to) * b.before.p + to * b.after.p + h * s * (1.0 - s) * ((1.0 - s) * b.before.v - s * b.after.v);
}

/// δψ = row · θ for the yaw of the body's x axis.
Eigen::RowVector3d yaw_row(const Matrix3d& R) {
  const Vec3 x = R.col(0);
  const double level = x.head<2>().squaredNorm();
  return {-x.z() * x.x() / level, -x.z() * x.y() / level, 1.0};
}

}  // namespace

std::optional<FixRows> fix_rows(const Msckf& filter, UTime filter_at, const PositionFix& fix) {
  const auto found = bracket(filter, filter_at, fix.at);
  if (!found) return std::nullopt;
  const Vec3 p = position_between(*found);
  const Index rows = fix.has_yaw ? 4 : 3;
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(rows, filter.covariance().cols());
  Eigen::VectorXd r(rows);
  r.head<3>() = (fix.position - p).cwiseQuotient(fix.variance.cwiseSqrt());
  const Matrix3d white = fix.variance.cwiseSqrt().cwiseInverse().asDiagonal();
  const auto add_pose = [&](const TimedPose& pose, double share) {
    H.block<3, 3>(0, pose.column) -= share * white * skew(pose.p);
    H.block<3, 3>(0, pose.column + 3) += share * white;
    if (fix.has_yaw) H.block<1, 3>(3, pose.column) += share * yaw_row(pose.R) / std::sqrt(fix.yaw_variance);
  };
  add_pose(found->before, 1.0 - found->share);
  add_pose(found->after, found->share);
  if (fix.has_yaw) {
    const Matrix3d turn = found->after.R * found->before.R.transpose();
    const Matrix3d R = exp_rotation(found->share * log_rotation(turn)) * found->before.R;
    r[3] = std::remainder(fix.yaw - std::atan2(R(1, 0), R(0, 0)), 2.0 * std::numbers::pi) / std::sqrt(fix.yaw_variance);
  }
  return FixRows{std::move(H), std::move(r)};
}

std::optional<FixOffset> fix_offset(const Msckf& filter, UTime filter_at, const PositionFix& fix) {
  const auto rows = fix_rows(filter, filter_at, fix);
  if (!rows) return std::nullopt;
  const double yaw = fix.has_yaw ? rows->r[3] * std::sqrt(fix.yaw_variance) : 0.0;
  return FixOffset{rows->r.head<3>().cwiseProduct(fix.variance.cwiseSqrt()), yaw};
}

bool RefusedFixes::add(const PositionFix& fix, const FixOffset& offset) {
  const Vec3 moved = (fix.position - offset.position) - (first_.position - first_offset_.position);
  const Vec3 noise = 3.0 * (fix.variance + first_.variance).cwiseSqrt();
  const double yaw_noise = 3.0 * std::sqrt(fix.yaw_variance + first_.yaw_variance);
  const Vec3 apart = (offset.position - first_offset_.position).cwiseAbs();
  const bool agrees = count_ > 0 && fix.has_yaw == first_.has_yaw &&
                      ((apart - noise).array() <= kDriftShare * moved.norm()).all() &&
                      std::abs(offset.yaw - first_offset_.yaw) <= yaw_noise;
  if (!agrees) {
    count_ = 0;
    first_ = fix;
    first_offset_ = offset;
  }
  return ++count_ >= kBelievedFixes;
}

void widen_by(const FixOffset& offset, Msckf& filter) {
  Eigen::Matrix<double, 6, 1> turn;
  turn << Vec3::UnitZ(), skew(filter.nav().p) * Vec3::UnitZ();
  Eigen::Matrix<double, 6, 6> D = offset.yaw * offset.yaw * turn * turn.transpose();
  D.bottomRightCorner<3, 3>() += offset.position.squaredNorm() * Matrix3d::Identity();
  filter.add_common_error(D);
}

FixOutcome use_fix(Msckf& filter, UTime filter_at, const PositionFix& fix) {
  const auto found = fix_rows(filter, filter_at, fix);
  if (!found) return FixOutcome::TooOld;
  const auto& [H, r] = *found;
  const Index rows = r.size();
  const Eigen::MatrixXd S =
      H * filter.covariance() * H.transpose() + Eigen::MatrixXd(Eigen::MatrixXd::Identity(rows, rows));
  const double limit = chi_square_quantile(static_cast<int>(rows), kGate9999);
  if (!(r.dot(S.llt().solve(r)) < limit)) return FixOutcome::Contradicts;
  filter.correct(H, r, 0);
  return FixOutcome::Used;
}

}  // namespace tern
