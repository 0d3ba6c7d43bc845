// The parts of the filter: rotations, Jacobians against finite differences, features, fixes, and the state at rest.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <functional>
#include <type_traits>

#include "core/base/random.h"
#include "estimator/filter/continuity.h"
#include "estimator/filter/feature.h"
#include "estimator/filter/input_check.h"
#include "estimator/filter/motion.h"
#include "estimator/filter/msckf.h"
#include "estimator/filter/position_fix.h"
#include "estimator/filter/rest.h"
#include "estimator/filter/rotation.h"
#include "estimator/masks.h"

namespace tern {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kCases = 50;
constexpr double kG = kGravity;

Vec3 normals(Rng& random, double scale = 1.0) {
  return scale * Vec3(random.normal(), random.normal(), random.normal());
}

NavState random_state(Rng& random) {
  return {exp_rotation(normals(random)), normals(random, 20.0), normals(random, 5.0), normals(random, 0.01),
          normals(random, 0.1)};
}

/// Central differences of f at zero.
MatrixXd derivative(const std::function<VectorXd(const VectorXd&)>& f, Eigen::Index columns, double step = 1e-5) {
  MatrixXd J(f(VectorXd::Zero(columns)).size(), columns);
  for (Eigen::Index k = 0; k < columns; ++k) {
    VectorXd x = VectorXd::Zero(columns);
    x[k] = step;
    J.col(k) = (f(x) - f(-x)) / (2.0 * step);
  }
  return J;
}

double largest(const MatrixXd& M) { return M.cwiseAbs().maxCoeff(); }

TEST(Frames, DoNotMix) {
  static_assert(!std::is_convertible_v<PointInO, PointInW>);
  static_assert(!std::is_assignable_v<PointInW&, PointInO>);
  static_assert(!std::is_convertible_v<PoseInO, PoseInW>);
  static_assert(!std::is_invocable_v<decltype([](const PointInW&) {}), PointInO>);
  const OdometryOffset T{Vec3(1.0, 2.0, 3.0), 0.7, 4};
  const PointInO x{Vec3(5.0, -6.0, 7.0)};
  EXPECT_LT((T.to_O(T.to_W(x)).xyz - x.xyz).norm(), 1e-12);
}

TEST(Rotation, IntegralsAreTheirSeries) {
  Rng random(1);
  for (const double scale : {1e-9, 1e-4, 0.009, 0.011, 0.5, 2.0}) {
    const Vec3 phi = scale * normals(random).normalized();
    Matrix3d power = Matrix3d::Identity(), exp = Matrix3d::Zero(), first = exp, second = exp;
    double factorial = 1.0;
    for (int k = 0; k < 30; ++k) {
      exp += power / factorial;
      first += power / (factorial * (k + 1));
      second += power / (factorial * (k + 1) * (k + 2));
      power = (power * skew(phi)).eval();
      factorial *= k + 1;
    }
    const RotationIntegrals turn = rotation_integrals(phi);
    EXPECT_LT(largest(turn.exp - exp), 1e-13);
    EXPECT_LT(largest(turn.first - first), 1e-13);
    EXPECT_LT(largest(turn.second - second), 1e-12) << scale;
    EXPECT_LT((log_rotation(turn.exp) - phi).norm(), 1e-12);
  }
}

TEST(Motion, MeanIsExactForAConstantRateAndForce) {
  // One step of 0.4 s is the same as 4000 steps.
  Rng random(2);
  for (int k = 0; k < 5; ++k) {
    const NavState start = random_state(random);
    const ImuStep step{normals(random), normals(random, 10.0), 0.4};
    ImuStep part = step;
    part.h /= 4000.0;
    NavState fine = start;
    for (int n = 0; n < 4000; ++n) fine = moved(fine, part, kG);
    EXPECT_LT(error_of(fine, moved(start, step, kG)).norm(), 1e-9);
  }
}

TEST(Motion, TransitionIsTheDerivativeOfTheError) {
  Rng random(3);
  for (int k = 0; k < kCases; ++k) {
    const NavState estimate = random_state(random);
    const ImuStep step{normals(random), normals(random, 10.0), 0.005};
    ImuStep half = step;
    half.h *= 0.5;
    const MatrixXd expected = derivative(
        [&](const VectorXd& error) -> VectorXd {
          return error_of(moved(estimate, step, kG), moved(corrected(estimate, error), step, kG));
        },
        kNavErrors);
    const ErrorTransition change = error_transition(moved(estimate, half, kG), step, ImuNoise{}, kG);
    EXPECT_LT(largest(change.Phi - expected), 5e-5);
  }
}

TEST(Motion, NoiseIsWhatNoisySamplesDo) {
  // The covariance of one step with white noise in rate and force, from the derivative by both.
  Rng random(4);
  const ImuNoise noise{};
  for (int k = 0; k < kCases; ++k) {
    const NavState estimate = random_state(random);
    const ImuStep step{normals(random), normals(random, 10.0), 0.005};
    ImuStep half = step;
    half.h *= 0.5;
    const MatrixXd G = derivative(
        [&](const VectorXd& n) -> VectorXd {
          ImuStep exact = step;
          exact.rate -= n.head<3>();
          exact.force -= n.tail<3>();
          return error_of(moved(estimate, step, kG), moved(estimate, exact, kG));
        },
        6);
    Eigen::Matrix<double, 6, 1> variance;
    variance << Vec3::Constant(noise.gyro * noise.gyro / step.h), Vec3::Constant(noise.accel * noise.accel / step.h);
    const MatrixXd expected = (G * variance.asDiagonal() * G.transpose()).topLeftCorner<9, 9>();
    const MatrixXd Q = error_transition(moved(estimate, half, kG), step, noise, kG).Q.topLeftCorner<9, 9>();
    // The position's own noise of one step (n² h³/3) is left out: 1e-9 m².
    EXPECT_LT(largest(Q - expected), 0.02 * largest(expected));
  }
}

TEST(Motion, OrdinaryErrorsAreTheDerivative) {
  Rng random(5);
  const NavState estimate = random_state(random);
  const MatrixXd expected = derivative(
      [&](const VectorXd& error) -> VectorXd {
        const NavState truth = corrected(estimate, error);
        NavVector out;
        out << log_rotation(truth.R * estimate.R.transpose()), truth.p - estimate.p, truth.v - estimate.v,
            truth.gyro_bias - estimate.gyro_bias, truth.accel_bias - estimate.accel_bias;
        return out;
      },
      kNavErrors);
  EXPECT_LT(largest(ordinary_error_jacobian(estimate) - expected), 1e-6);
}

TEST(Motion, CorrectedAndErrorOfAreInverse) {
  Rng random(6);
  for (int k = 0; k < kCases; ++k) {
    const NavState a = random_state(random), b = random_state(random);
    EXPECT_LT(error_of(corrected(a, error_of(a, b)), b).norm(), 1e-9);
  }
}

/// Views of one feature from poses along a line, without noise.
struct Views {
  std::vector<NavState> bodies;
  Matrix3d R_BC = exp_rotation(Vec3(-1.2, 1.2, -1.2));
  Vec3 p_BC = Vec3(0.1, 0.05, 0.0);
  Vec3 x = Vec3(30.0, 2.0, 1.0);

  std::vector<PosedView> posed(const std::vector<PosedView>* measured = nullptr) const {
    std::vector<PosedView> out;
    for (std::size_t k = 0; k < bodies.size(); ++k) {
      PosedView view{bodies[k].R * R_BC, bodies[k].p + bodies[k].R * p_BC, 0.11, 1.0 / 460.0, {}, static_cast<int>(k)};
      const Vec3 x_C = view.R_WC.transpose() * (x - view.p_WC);
      view.z.left = projected(x_C);
      view.z.right = projected(Vec3(x_C - Vec3(0.11, 0.0, 0.0)));
      if (measured != nullptr) view.z = (*measured)[k].z;
      out.push_back(view);
    }
    return out;
  }
};

Views some_views(Rng& random) {
  Views views;
  // The camera looks along +x of the world, whatever R_BC is.
  Matrix3d R_WC;
  R_WC << 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0;
  for (int k = 0; k < 5; ++k) {
    NavState body;
    body.R = exp_rotation(normals(random, 0.1)) * R_WC * views.R_BC.transpose();
    body.p = Vec3(20.0 + 0.3 * k, 0.1 * k, 1.0) + normals(random, 0.1);
    views.bodies.push_back(body);
  }
  views.x = Vec3(30.0, 0.0, 1.0) + normals(random, 2.0);
  return views;
}

TEST(Feature, JacobiansAreTheDerivatives) {
  Rng random(7);
  for (int k = 0; k < kCases; ++k) {
    const Views views = some_views(random);
    const std::vector<PosedView> measured = views.posed();
    const FeatureRows rows = feature_rows(measured, views.x, 5);
    EXPECT_LT(rows.r.norm(), 1e-9);
    // r is the error's own residual: z of the truth minus what the estimate expects.
    const auto residual = [&](const VectorXd& error) -> VectorXd {
      Views truth = views;
      for (std::size_t n = 0; n < 5; ++n) {
        NavVector of_body = NavVector::Zero();
        of_body.head<6>() = error.segment<6>(6 * static_cast<Eigen::Index>(n));
        truth.bodies[n] = corrected(views.bodies[n], of_body);
      }
      truth.x += error.tail<3>();
      const std::vector<PosedView> z = truth.posed();
      return feature_rows(views.posed(&z), views.x, 5).r;
    };
    const MatrixXd expected = derivative(residual, 33, 1e-6);
    MatrixXd H(rows.r.size(), 33);
    H << rows.H_x, rows.H_f;
    EXPECT_LT(largest(H - expected), 1e-5 * largest(expected));
  }
}

TEST(Feature, EliminationKeepsWhatTheSchurComplementSays) {
  Rng random(8);
  const Views views = some_views(random);
  FeatureRows rows = feature_rows(views.posed(), views.x, 5);
  for (Eigen::Index k = 0; k < rows.r.size(); ++k) rows.r[k] = random.normal();
  const MatrixXd H = rows.H_x, F = rows.H_f;
  const MatrixXd across = MatrixXd::Identity(F.rows(), F.rows()) - F * (F.transpose() * F).inverse() * F.transpose();
  const VectorXd gradient = H.transpose() * across * rows.r;
  eliminate_feature(rows);
  EXPECT_EQ(rows.r.size(), F.rows() - 3);
  EXPECT_LT(largest(rows.H_x.transpose() * rows.H_x - H.transpose() * across * H), 1e-7 * largest(H.transpose() * H));
  EXPECT_LT((rows.H_x.transpose() * rows.r - gradient).norm(), 1e-7 * gradient.norm());
  MatrixXd stacked(40, 6);
  VectorXd r(40);
  for (Eigen::Index k = 0; k < 40; ++k) {
    r[k] = random.normal();
    for (Eigen::Index j = 0; j < 6; ++j) stacked(k, j) = random.normal();
  }
  const MatrixXd information = stacked.transpose() * stacked;
  const VectorXd of_r = stacked.transpose() * r;
  compress(stacked, r);
  EXPECT_EQ(stacked.rows(), 6);
  EXPECT_LT(largest(stacked.transpose() * stacked - information), 1e-12 * largest(information));
  EXPECT_LT((stacked.transpose() * r - of_r).norm(), 1e-11);
}

TEST(Feature, TriangulationFindsTheFeature) {
  Rng random(9);
  for (int k = 0; k < kCases; ++k) {
    Views views = some_views(random);
    auto x = triangulated(views.posed());
    ASSERT_TRUE(x);
    EXPECT_LT((*x - views.x).norm(), 1e-6);
    views.x = views.bodies[0].p + Vec3(1e5, 2e4, 0.0);  // the horizon: the direction counts
    x = triangulated(views.posed());
    ASSERT_TRUE(x);
    EXPECT_GT((*x - views.bodies[0].p).normalized().dot((views.x - views.bodies[0].p).normalized()), 1.0 - 1e-6);
  }
}

TEST(PositionFix, JacobianIsTheDerivative) {
  Rng random(10);
  const NavMatrix P = NavMatrix::Identity();
  for (int k = 0; k < kCases; ++k) {
    NavState state = random_state(random);
    state.R = exp_rotation(normals(random, 0.3));
    PositionFix fix;
    fix.at = UTime{1000};
    fix.variance = Vec3(0.04, 0.09, 0.25);
    fix.has_yaw = true;
    fix.yaw_variance = 0.01;
    const auto with = [&](const NavState& truth) {
      fix.position = truth.p;
      fix.yaw = std::atan2(truth.R(1, 0), truth.R(0, 0));
      return *fix_rows(Msckf(state, P), fix.at, fix);
    };
    const MatrixXd expected = derivative(
        [&](const VectorXd& error) -> VectorXd { return with(corrected(state, error)).r; }, kNavErrors, 1e-6);
    EXPECT_LT(largest(with(state).H - expected), 1e-4);
  }
}

TEST(RestStart, TiltAndBiasAreOneUnknown) {
  Rng random(11);
  EstimatorConfig config;
  for (int k = 0; k < 20; ++k) {
    NavState truth;
    truth.R = exp_rotation(Vec3(0.0, 0.0, 2.0)) * exp_rotation(normals(random, 0.05));
    truth.p = Vec3(3.0, 4.0, 5.0);
    truth.accel_bias = normals(random, 0.03);
    truth.gyro_bias = normals(random, 0.01);
    const RestMean mean{truth.gyro_bias, truth.R.transpose() * Vec3(0.0, 0.0, kG) + truth.accel_bias, 2.0};
    const double yaw = std::atan2(truth.R(1, 0), truth.R(0, 0));
    const auto [state, P] = state_at_rest(mean, config, {PointInW{truth.p}, yaw});
    const NavVector error = error_of(state, truth);
    // The error in the tilt is the one that the covariance foretells from the bias: no noise was added.
    const Vec3 bias = state.R * error.segment<3>(kErrorBa);
    EXPECT_NEAR(error[kTheta], -bias.y() / kG, 2e-4);
    EXPECT_NEAR(error[kTheta + 1], bias.x() / kG, 2e-4);
    const double nees = error.dot(P.ldlt().solve(error));
    EXPECT_LT(nees, 30.0);
    Eigen::Matrix<double, 3, kNavErrors> of_acceleration = Eigen::Matrix<double, 3, kNavErrors>::Zero();
    of_acceleration.middleCols<3>(kTheta) = skew(Vec3(0.0, 0.0, -kG));
    of_acceleration.middleCols<3>(kErrorBa) = -state.R;
    const Matrix3d P_a = of_acceleration * P * of_acceleration.transpose();
    EXPECT_LT(std::sqrt(P_a(0, 0)), 0.021);  // a_n/√T, not the 0.03 m/s² of the bias
  }
}

TEST(Continuity, SmallCorrectionsMoveThePoseAndLargeOnesTheOffset) {
  const OdometryOffset T{Vec3(1.0, 2.0, 0.5), 0.4, 3};
  const PoseInW before{exp_rotation(Vec3(0.1, -0.2, 0.7)), Vec3(10.0, 20.0, 2.0)};
  const PoseInW near{exp_rotation(Vec3(0.0, 0.0, 0.004)) * before.R, before.p + Vec3(0.004, 0.0, 0.0)};
  EXPECT_EQ(after_correction(T, before, near, 0.01, 0.01).epoch, 3);
  EXPECT_EQ(after_correction(T, before, near, 0.01, 0.01).translation, T.translation);

  const PoseInW far{exp_rotation(Vec3(0.02, 0.0, 0.3)) * before.R, before.p + Vec3(0.6, -0.1, 0.2)};
  const OdometryOffset moved = after_correction(T, before, far, 0.01, 0.01);
  EXPECT_EQ(moved.epoch, 4);
  const PoseInO in_O = moved.to_O(far), was = T.to_O(before);
  EXPECT_LT((in_O.p - was.p).norm(), 1e-12);
  EXPECT_LT(std::abs(twist_about_z(in_O.R * was.R.transpose())), 1e-3);
  EXPECT_GT(largest(in_O.R - was.R), 0.01);  // roll and pitch are corrected
}

TEST(Continuity, NoCorrectionMovesThePositionInOByMoreThanItsLimit) {
  Rng random(11);
  int offsets = 0;
  for (int k = 0; k < 10'000; ++k) {
    const OdometryOffset T{normals(random, 5.0), random.uniform(-3.0, 3.0), 7};
    const PoseInW before{exp_rotation(normals(random)), normals(random, 20.0)};
    const PoseInW after{exp_rotation(normals(random, 0.02)) * before.R, before.p + normals(random, 0.01)};
    const OdometryOffset corrected = after_correction(T, before, after, 0.01, 0.01);
    EXPECT_LE((corrected.to_O(after).p - T.to_O(before).p).norm(), 0.01 + 1e-12);
    offsets += corrected.epoch == 8 ? 1 : 0;
  }
  EXPECT_GT(offsets, 1'000);
  EXPECT_LT(offsets, 9'900);
}

TEST(Masks, HideWhatMayLieOnAMover) {
  FeatureFrame frame;
  frame.q_BC = {0.5, -0.5, 0.5, -0.5};  // z forward, x right, y down
  frame.baseline_m = 0.1;
  frame.sigma = 1e-3;
  StereoFeature feature;
  feature.right = {-0.1 / 10.0, 0.0};  // 10 m ahead
  frame.features = {feature};
  const Masks near{{}, {box_around(Vec3(5.0, 0.0, 0.0), Vec3::Constant(0.5))}};
  const Masks far{{}, {box_around(Vec3(30.0, 0.0, 0.0), Vec3::Constant(0.5))}};
  const Masks beside{{}, {box_around(Vec3(5.0, 2.0, 0.0), Vec3::Constant(0.5))}};
  const Masks behind{{}, {box_around(Vec3(-5.0, 0.0, 0.0), Vec3::Constant(0.5))}};
  const Masks image{{Eigen::AlignedBox2d(Eigen::Vector2d(-0.1, -0.1), Eigen::Vector2d(0.1, 0.1))}, {}};
  EXPECT_EQ(unmasked(frame, near, {}).features.size(), 0u);
  EXPECT_EQ(unmasked(frame, far, {}).features.size(), 1u);
  EXPECT_EQ(unmasked(frame, beside, {}).features.size(), 1u);
  EXPECT_EQ(unmasked(frame, behind, {}).features.size(), 1u);
  EXPECT_EQ(unmasked(frame, image, {}).features.size(), 0u);
  const Masks around{{}, {box_around(Vec3::Zero(), Vec3::Constant(60.0))}};
  EXPECT_EQ(unmasked(frame, around, {}).features.size(), 1u) << "it would hide every feature";
  EXPECT_EQ(unmasked(frame, near, {exp_rotation(Vec3(0.0, 0.0, 1.5)), Vec3::Zero()}).features.size(), 1u);
}

}  // namespace
}  // namespace tern
