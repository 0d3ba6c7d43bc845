// MAVLink's ODOMETRY as Tern's: frames and covariances against a sender that converts by rotation matrices, resets,
// and what a sender leaves open.
#include "mavlink/odometry_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

#include "core/base/random.h"
#include "mavlink/axes.h"

namespace tern::mavlink {
namespace {

using testing::HasSubstr;
using Matrix = Eigen::Matrix3d;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr std::uint8_t kLocalNed = 1, kBodyFrd = 12, kLocalFrd = 20;
constexpr UTime kStart{1'000'000'000};
const Vec3 kOrigin(3.0, -2.0, 0.0);

Vec3 normal(Rng& rng) {
  const double x = rng.normal(), y = rng.normal(), z = rng.normal();
  return {x, y, z};
}

/// A random covariance of full rank, with correlations.
PoseCovariance random_covariance(Rng& rng) {
  PoseCovariance root;
  for (int k = 0; k < 36; ++k) root(k / 6, k % 6) = 0.1 * rng.normal();
  return root * root.transpose();
}

std::array<float, 21> triangle_of(const PoseCovariance& whole) {
  std::array<float, 21> out{};
  std::size_t at = 0;
  for (int row = 0; row < 6; ++row) {
    for (int column = row; column < 6; ++column) out[at++] = static_cast<float>(whole(row, column));
  }
  return out;
}

std::array<float, 21> variances(float position, float rotation, float open = kNan) {
  std::array<float, 21> out{};
  out.fill(open);
  out[0] = out[6] = out[11] = position;
  out[15] = out[18] = out[20] = rotation;
  return out;
}

/// A usable message at rest at the sender's origin, as a PX4 sends it: 0.1 m, 0.01 rad, 0.05 m/s.
Odometry message() {
  Odometry m;
  m.q = {1, 0, 0, 0};
  m.pose_covariance = variances(0.01F, 1e-4F);
  m.velocity_covariance = variances(2.5e-3F, kNan);
  m.frame_id = kLocalNed;
  m.child_frame_id = kBodyFrd;
  return m;
}

PoseCovariance matrix_of(const std::array<double, 36>& rows) {
  return Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(rows.data());
}

UTime at(double seconds) { return kStart + Duration::from_seconds(seconds); }

/// The sender's axes in W, in words: north is W's y, east W's x, down −z. The body's axes are x, −y, −z of Tern's.
TEST(OdometryReport, IsTheInverseOfASenderThatConvertsByMatrices) {
  Matrix ned_enu, frd_flu = Vec3(1, -1, -1).asDiagonal();
  ned_enu << 0, 1, 0, 1, 0, 0, 0, 0, -1;
  Rng rng(1);
  for (int n = 0; n < 200; ++n) {
    const Vec3 p = 10.0 * normal(rng), v = 3.0 * normal(rng), w = normal(rng);
    const Eigen::Quaterniond q_WB =
        Eigen::Quaterniond(rng.normal(), rng.normal(), rng.normal(), rng.normal()).normalized();
    const Matrix R = q_WB.toRotationMatrix();
    PoseCovariance big = PoseCovariance::Zero();
    big.topLeftCorner<3, 3>() = big.bottomRightCorner<3, 3>() = ned_enu;
    const PoseCovariance covariance = random_covariance(rng);
    const bool in_body = n % 2 == 0;
    const Matrix V = random_covariance(rng).topLeftCorner<3, 3>(),
                 R_VW = in_body ? Matrix(frd_flu * R.transpose()) : ned_enu;

    Odometry m = message();
    m.frame_id = n % 3 == 0 ? kLocalFrd : kLocalNed;
    m.child_frame_id = in_body ? kBodyFrd : kLocalNed;
    const Vec3 p_ned = ned_enu * (p - kOrigin), v_sent = R_VW * v, w_frd = frd_flu * w;
    for (int k = 0; k < 3; ++k) {
      m.p[idx(k)] = static_cast<float>(p_ned[k]);
      m.v[idx(k)] = static_cast<float>(v_sent[k]);
      m.rates[idx(k)] = static_cast<float>(w_frd[k]);
    }
    m.q = wxyz_of(Eigen::Quaterniond(Matrix(ned_enu * R * frd_flu)));
    m.pose_covariance = triangle_of(big * covariance * big.transpose());
    PoseCovariance velocity = PoseCovariance::Zero();
    velocity.topLeftCorner<3, 3>() = R_VW * V * R_VW.transpose();
    m.velocity_covariance = triangle_of(velocity);

    OdometryReport report({}, kOrigin);
    report.add(m, kStart);
    ASSERT_EQ(report.fault(kStart), "") << n;
    const tern::Odometry out = *report.newest();
    const OdometryOffset T_WO{out.p_WO, out.yaw_WO, out.epoch};
    EXPECT_LT((T_WO.to_W(PointInO{out.p_OB}).xyz - p).norm(), 1e-5);
    EXPECT_LT((T_WO.to_W(VectorInO{out.v_OB}).xyz - v).norm(), 1e-5);
    EXPECT_LT((out.angular_velocity - w).norm(), 1e-5);
    const Eigen::Quaterniond q_OB(out.q_OB[0], out.q_OB[1], out.q_OB[2], out.q_OB[3]);
    EXPECT_LT((T_WO.rotation() * q_OB.toRotationMatrix() - R).norm(), 1e-5);
    EXPECT_LT((matrix_of(out.pose_covariance) - covariance).norm(), 1e-6);
    EXPECT_LT((Eigen::Map<const Matrix>(out.velocity_covariance.data()) - V).norm(), 1e-6);
    EXPECT_EQ(out.epoch, 0);
    EXPECT_EQ(out.state, EstimatorState::Tracking);
  }
}

TEST(OdometryReport, BoundsEveryCorrelationThatASenderLeavesOpen) {
  Rng rng(2);
  for (int n = 0; n < 500; ++n) {
    const PoseCovariance truth = random_covariance(rng);  // NED
    Odometry m = message();
    m.pose_covariance.fill(kNan);
    std::size_t diagonal = 0;
    for (int k = 0; k < 6; diagonal += idx(6 - k), ++k) m.pose_covariance[diagonal] = static_cast<float>(truth(k, k));
    const auto stated = stated_pose(m, {});
    ASSERT_TRUE(stated);
    PoseCovariance S = PoseCovariance::Zero();
    S.topLeftCorner<3, 3>() << 0, 1, 0, 1, 0, 0, 0, 0, -1;
    S.bottomRightCorner<3, 3>() = S.topLeftCorner<3, 3>();
    const PoseCovariance left = stated->covariance - S * truth * S.transpose();
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<PoseCovariance>(left).eigenvalues()[0], -1e-6);
    const auto trusting = stated_pose(m, {.correlated = false});
    ASSERT_TRUE(trusting);
    EXPECT_NEAR(trusting->covariance(0, 0), truth(1, 1), 1e-6) << "W's x is east, the sender's y";
    EXPECT_EQ(trusting->covariance(0, 1), 0.0);
  }
}

TEST(OdometryReport, AResetMovesTheFrameOAndNotThePoseInIt) {
  OdometryReport report({}, kOrigin);
  Odometry m = message();
  const double turn = 0.2;  // of the heading, by the reset, about up
  Vec3 p(0, 0, 1), before = p;
  const Vec3 v(2, 1, 0);
  for (int k = 0; k < 200; ++k) {
    const bool is_after = k >= 100;
    p += 0.01 * v;
    Vec3 shown = p;
    if (is_after) shown = Eigen::AngleAxisd(turn, Vec3::UnitZ()) * p + Vec3(0.4, -0.3, 0.1);
    m.reset_counter = is_after ? 255 : 254;
    m.p = ned_of(shown);
    m.q = wxyz_of(swapped(Eigen::Quaterniond(Eigen::AngleAxisd(0.3 + (is_after ? turn : 0.0), Vec3::UnitZ()))));
    m.child_frame_id = kLocalNed;
    m.v = ned_of(is_after ? Vec3(Eigen::AngleAxisd(turn, Vec3::UnitZ()) * v) : v);
    report.add(m, at(0.01 * k));
    ASSERT_EQ(report.fault(at(0.01 * k)), "");
    const tern::Odometry& out = *report.newest();
    EXPECT_EQ(out.epoch, is_after ? 1 : 0);
    ASSERT_TRUE(k == 0 || (out.p_OB - before - 0.01 * v).norm() < 1e-5) << "at " << k;
    before = out.p_OB;
    EXPECT_LT((out.v_OB - v).norm(), 1e-5);
    const OdometryOffset T_WO{out.p_WO, out.yaw_WO, out.epoch};
    EXPECT_LT((T_WO.to_W(PointInO{out.p_OB}).xyz - shown - kOrigin).norm(), 1e-5) << "in W it is what the sender says";
  }
  EXPECT_NEAR(report.newest()->yaw_WO, turn, 1e-5);
  m.p[0] += 0.5F;  // a jump that the sender does not count
  report.add(m, at(2.0));
  EXPECT_EQ(report.newest()->epoch, 2);
}

TEST(OdometryReport, WithoutCovarianceIsRefusedOrAssumed) {
  Odometry m = message();
  m.pose_covariance.fill(kNan);
  OdometryReport strict({}, kOrigin);
  strict.add(m, kStart);
  EXPECT_FALSE(strict.newest());
  EXPECT_THAT(strict.fault(kStart), HasSubstr("how wrong its position is (pose_covariance is nan)"));
  EXPECT_THAT(strict.fault(kStart), HasSubstr("mavlink.odometry_sigma_m"));

  OdometryReport half({.sigma_m = 0.2}, kOrigin);
  half.add(m, kStart);
  EXPECT_THAT(half.fault(kStart), HasSubstr("mavlink.odometry_sigma_deg"));

  OdometryReport assuming({.sigma_m = 0.2, .sigma_rad = 0.1, .correlated = false}, kOrigin);
  assuming.add(m, kStart);
  ASSERT_EQ(assuming.fault(kStart), "");
  EXPECT_NEAR(assuming.newest()->pose_covariance[7], 0.04, 1e-9);
  EXPECT_NEAR(assuming.newest()->pose_covariance[35], 0.03, 1e-9) << "about any axis";

  m.pose_covariance = variances(0.0F, 1e-4F, 0.0F);  // a sender that fills nothing in
  strict.add(m, at(0.1));
  EXPECT_FALSE(strict.newest()) << "0 is no error, so it is no statement";
  EXPECT_THAT(strict.fault(kStart), HasSubstr("pose_covariance is 0"));
  m.pose_covariance = variances(1.0F, 1.0F, 5.0F);
  strict.add(m, at(0.2));
  EXPECT_THAT(strict.fault(kStart), HasSubstr("is not a covariance"));
}

TEST(OdometryReport, ThatHasFailedIsLost) {
  OdometryReport report({}, kOrigin);
  Odometry m = message();
  report.add(m, kStart);
  EXPECT_EQ(report.fault(kStart), "") << "quality 0: not stated, as of a PX4";
  m.quality = 80;
  report.add(m, at(0.03));
  m.quality = 0;
  report.add(m, at(0.06));
  EXPECT_EQ(report.newest()->state, EstimatorState::Lost) << "this sender states its quality";
  EXPECT_THAT(report.fault(at(0.06)), HasSubstr("has failed (quality 0)"));
  m.quality = 1;
  report.add(m, at(0.09));
  EXPECT_EQ(report.newest()->state, EstimatorState::Tracking);
  m.quality = -1;
  report.add(m, at(0.12));
  EXPECT_EQ(report.newest()->state, EstimatorState::Lost);
  EXPECT_EQ(report.newest()->at, at(0.12));
}

TEST(OdometryReport, ThatCannotBeUsedSaysWhy) {
  OdometryReport report({.max_sigma_m = 0.3}, kOrigin);
  EXPECT_THAT(report.fault(kStart), HasSubstr("no ODOMETRY has come"));
  Odometry m = message();
  m.frame_id = 0;
  report.add(m, kStart);
  EXPECT_THAT(report.fault(kStart), HasSubstr("frames 0 and 12"));
  m = message();
  m.v[1] = kNan;
  report.add(m, at(0.01));
  EXPECT_THAT(report.fault(kStart), HasSubstr("not finite"));
  report.add(message(), at(0.02));
  EXPECT_EQ(report.fault(at(0.3)), "");
  EXPECT_THAT(report.fault(at(0.4)), HasSubstr("0.4 s old"));
  report.refuse("a reason");
  EXPECT_EQ(report.fault(at(0.3)), "") << "one message is not the estimate";
  EXPECT_THAT(report.fault(at(0.4)), HasSubstr("ODOMETRY is not used: a reason"));
  m = message();
  m.pose_covariance = variances(0.04F, 1e-4F);  // √6 · 0.2 m
  report.add(m, at(0.5));
  EXPECT_THAT(report.fault(at(0.5)), HasSubstr("0.49 m, above mavlink.odometry_max_sigma_m (0.3 m)"));
}

/// A velocity error that is constant for a second is the worst one for its variance; corrections of the position.
TEST(OdometryReport, ItsDriftBoundsThatOfAFilterWithThisCovariance) {
  constexpr double kSigmaV = 0.1, kGrowth = 0.002;  // m/s; m² per second
  Rng rng(3);
  double squares = 0.0, bound = 0.0;
  constexpr int kFlights = 400;
  for (int n = 0; n < kFlights; ++n) {
    OdometryReport report({.correlated = false}, kOrigin);
    Odometry m = message();
    m.child_frame_id = kLocalNed;
    m.velocity_covariance = variances(static_cast<float>(kSigmaV * kSigmaV), kNan);
    double error = 0.0, variance = 1.0;
    const double e_v = kSigmaV * rng.normal();
    for (int k = 0; k <= 50; ++k) {
      const double taken = k % 10 == 9 ? 0.004 : 0.0;  // a correction takes this variance away
      error += 0.02 * e_v + std::sqrt(taken) * rng.normal();
      variance += kGrowth * 0.02 - taken;
      m.pose_covariance = variances(static_cast<float>(variance), 1e-4F);
      report.add(m, at(0.02 * k));
    }
    squares += error * error;
    bound = report.drift_sigma().x();
  }
  const double rms = std::sqrt(squares / kFlights);
  EXPECT_GT(bound, rms);
  EXPECT_LT(bound, 2.0 * rms) << "and not by much";
}

TEST(OdometryReport, ItsDriftIsAtMostTwoErrorsAndFourAfterAReset) {
  OdometryReport report({}, kOrigin);
  Odometry m = message();
  m.velocity_covariance.fill(kNan);
  report.add(m, kStart);
  EXPECT_NEAR(report.drift_sigma().x(), 0.2, 1e-6);
  EXPECT_NEAR(report.newest()->velocity_covariance[0], OdometryReport::kUnknownVariance, 1.0);
  ++m.reset_counter;
  report.add(m, at(0.1));
  EXPECT_NEAR(report.drift_sigma().x(), 0.4, 1e-6);
  for (int k = 2; k < 14; ++k) report.add(m, at(0.1 * k));
  EXPECT_NEAR(report.drift_sigma().x(), 0.2, 1e-6) << "a second later";
}

}  // namespace
}  // namespace tern::mavlink
