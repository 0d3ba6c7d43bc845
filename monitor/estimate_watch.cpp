#include "monitor/estimate_watch.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/world/frames.h"
#include "core/world/stated_bound.h"

namespace tern {
namespace {

constexpr Duration kRemembered{1'000'000};
/// A longer time without ODOMETRY is not counted as blind: the estimator was dead.
constexpr double kLongestGap = 0.5;  // s

}  // namespace

void EstimateWatch::add(const Odometry& odometry) {
  if (odometry.state != EstimatorState::Tracking && odometry.state != EstimatorState::Blind) return;
  waiting_.push_back(odometry);
  compare();
}

void EstimateWatch::add_truth(const UavState& truth) {
  if (!truths_.empty() && truth.at <= truths_.back().at) return;
  has_moved_ = has_moved_ || truth.motion.v.norm() > kMoving;
  true_ = truth.motion.p;
  truths_.push_back(truth);
  while (truth.at - truths_.front().at > kRemembered) truths_.pop_front();
  compare();
}

void EstimateWatch::compare() {
  while (!waiting_.empty() && !truths_.empty() && waiting_.front().at <= truths_.back().at) {
    const Odometry odometry = waiting_.front();
    waiting_.pop_front();
    const auto after =
        std::find_if(truths_.begin(), truths_.end(), [&](const UavState& t) { return t.at >= odometry.at; });
    if (after->at != odometry.at && after == truths_.begin()) continue;
    const double back = (after->at - odometry.at).seconds();
    const Vec3& v = after->motion.v;
    const Vec3& a = after->motion.a;
    if (has_moved_) compare(odometry, after->motion.p - back * v + 0.5 * back * back * a);
  }
}

void EstimateWatch::compare(const Odometry& odometry, const Vec3& truth) {
  const OdometryOffset offset{odometry.p_WO, odometry.yaw_WO, odometry.epoch};
  const Vec3 error = offset.to_W(PointInO{odometry.p_OB}).xyz - truth;
  const Eigen::Matrix3d covariance = position_covariance(odometry.pose_covariance);
  const double nees = error.dot(covariance.ldlt().solve(error));
  ++count_;
  sums_.end_m = error.norm();
  sums_.sigma_end_m = std::sqrt(std::max(covariance.trace(), 0.0));
  sums_.peak_m = std::max(sums_.peak_m, sums_.end_m);
  sums_.sigma_peak_m = std::max(sums_.sigma_peak_m, sums_.sigma_end_m);
  sums_.corrections = odometry.epoch;
  squares_ += error.squaredNorm();
  nees_ += nees / 3.0;
  covered_ += nees < kChiSquared3 ? 1.0 : 0.0;
  states_tracks_ = states_tracks_ || odometry.tracks > 0;
  if (compared_ && odometry.tracks < kFewTracks) {
    const double passed = (odometry.at - *compared_).seconds();
    if (passed < kLongestGap) sums_.blind_s += passed;
  }
  compared_ = odometry.at;
}

std::optional<EstimateMeasures> EstimateWatch::measures(const Vec3& goal) const {
  if (count_ == 0) return std::nullopt;
  EstimateMeasures measures = sums_;
  const auto n = static_cast<double>(count_);
  if (!states_tracks_) measures.blind_s = std::nan("");
  measures.rmse_m = std::sqrt(squares_ / n);
  measures.anees = nees_ / n;
  measures.coverage = covered_ / n;
  measures.believed_to_goal_m = believed_ ? (*believed_ - goal).norm() : std::nan("");
  measures.true_to_goal_m = true_ ? (*true_ - goal).norm() : std::nan("");
  return measures;
}

}  // namespace tern
