#include "predictor/models/world_error.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"

namespace tern {
namespace {

Odometry odometry_at(const Vec3& p) {
  Odometry odometry;
  odometry.at = UTime{1'000'000};
  odometry.state = EstimatorState::Tracking;
  odometry.p_OB = p;
  return odometry;
}

/// The margin at x of a fresh estimate.
double margin_at(const WorldError& error, const Vec3& x) { return error.pose_error(UTime{1'000'000}).margin(x); }

TEST(WorldError, NothingIsKnownWithoutAnEstimate) {
  WorldError error;
  EXPECT_FALSE(error.is_known());
  error.add(Odometry{});  // an estimator that starts
  EXPECT_FALSE(error.is_known());
}

TEST(WorldError, MarginIsTheQuantileOfThePositionsErrorNearby) {
  WorldError error;
  Odometry odometry = odometry_at(Vec3(5, 0, 1));
  odometry.pose_covariance[0] = 0.01;
  error.add(odometry);
  EXPECT_NEAR(margin_at(error, Vec3(5, 0, 1)), 0.35, 1e-12);  // 3.368 · 0.1, rounded up
}

TEST(WorldError, YawErrorCountsByDistance) {
  WorldError error;
  Odometry odometry = odometry_at(Vec3(0, 0, 1));
  odometry.pose_covariance[35] = 0.01 * 0.01;
  error.add(odometry);
  EXPECT_NEAR(margin_at(error, Vec3(30, 0, 1)), std::ceil(3.368 * 0.3 / 0.05) * 0.05, 1e-9);
  EXPECT_EQ(margin_at(error, Vec3(0, 0, 30)), 0.0);
}

/// Draws poses from the covariance, and looks where a thing known in W truly is relative to the believed pose.
TEST(WorldError, ContainsTheTrueDisplacementInNinetyNinePercent) {
  Rng rng(1);
  Eigen::Matrix<double, 6, 6> L = Eigen::Matrix<double, 6, 6>::Zero();
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column <= row; ++column) L(row, column) = (row < 3 ? 0.1 : 0.004) * rng.uniform(-1.0, 1.0);
  }
  const Eigen::Matrix<double, 6, 6> P = L * L.transpose();
  WorldError error;
  Odometry odometry = odometry_at(Vec3(40, -5, 2));
  for (int k = 0; k < 36; ++k) odometry.pose_covariance[idx(k)] = P(k / 6, k % 6);
  error.add(odometry);
  const Vec3 x(52, 4, 0);
  const double margin = margin_at(error, x);
  constexpr int kDraws = 20'000;
  int outside = 0;
  for (int k = 0; k < kDraws; ++k) {
    Eigen::Matrix<double, 6, 1> n;
    for (int i = 0; i < 6; ++i) n[i] = rng.normal();
    const Eigen::Matrix<double, 6, 1> e = L * n;
    const Vec3 p = odometry.p_OB + e.head<3>();
    const Eigen::AngleAxisd turn(e.tail<3>().norm(), e.tail<3>().normalized());
    const Vec3 seen = odometry.p_OB + turn.inverse() * (x - p);
    outside += (seen - x).norm() > margin ? 1 : 0;
  }
  EXPECT_LE(outside, kDraws / 100);
}

TEST(WorldError, ACorrectionThatIsStillFollowedCounts) {
  WorldError error;
  Odometry odometry = odometry_at(Vec3(5, 0, 1));
  odometry.v_OB = Vec3(4, 0, 0);
  odometry.p_WO = Vec3(0, 0.42, 0);
  error.add(odometry);
  error.add_vehicle(Vec3(5.04, 0.0, 1), odometry.at + Duration{10'000});
  EXPECT_NEAR(margin_at(error, Vec3(5, 0, 1)), 0.45, 1e-9);
}

/// An estimator that has ended at 4 m/s, or is lost.
TEST(WorldError, OfAStaleEstimateGrowsByTheStatedDriftAndEnds) {
  for (const bool is_lost : {true, false}) {
    WorldError error;
    Odometry odometry = odometry_at(Vec3(5, 0, 1));
    odometry.v_OB = Vec3(4, 0, 0);
    error.add(odometry);
    UTime at = odometry.at;
    const auto widened = [&] {
      Track track;
      track.motion.pieces.assign(1, CubicPiece{Duration{500'000}, PowerCubic::Zero()});
      track.alpha = {Vec3::Zero()};
      std::vector<Track> tracks{track};
      widen(tracks, error.pose_error(at), at);
      return tracks[0].alpha[0].x();
    };
    for (int k = 1; k <= 300; ++k) {
      at = odometry.at + Duration{k * 100'000};
      if (is_lost) {
        Odometry lost = odometry;
        lost.at = at;
        lost.state = EstimatorState::Lost;
        error.add(lost);
      }
      error.add_vehicle(Vec3(5, 0, 1) + std::min(0.1 * k, 1.0) * Vec3(4, 0, 0), at);  // it brakes after a second
      EXPECT_EQ(error.is_stale(at), k > 3);
      const double drift = std::clamp(WorldError::kDriftSpeed * (0.1 * k - 0.3), 0.0, WorldError::kMostDrift);
      ASSERT_NEAR(widened(), drift, PoseError::kStep + 1e-9) << "after " << 0.1 * k << " s";
    }
    odometry.at = at;
    error.add(odometry);
    EXPECT_LT(widened(), 0.1);
  }
}

TEST(WorldError, EveryPieceOfATrackIsWidened) {
  WorldError error;
  Odometry odometry = odometry_at(Vec3(0, 0, 1));
  odometry.pose_covariance[0] = 0.01;
  error.add(odometry);
  Track track;
  track.motion.pieces.assign(2, CubicPiece{Duration{500'000}, PowerCubic::Zero()});
  track.alpha = {Vec3(0.1, 0.2, 0.3), Vec3::Zero()};
  std::vector<Track> tracks{track};
  widen(tracks, error.pose_error(odometry.at), UTime{});
  EXPECT_NEAR((tracks[0].alpha[0] - Vec3(0.45, 0.55, 0.65)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((tracks[0].alpha[1] - Vec3::Constant(0.35)).norm(), 0.0, 1e-12);
}

}  // namespace
}  // namespace tern
