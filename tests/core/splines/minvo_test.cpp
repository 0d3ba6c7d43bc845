#include "core/splines/minvo.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "core/splines/clamped_spline.h"
#include "tests/support/random_splines.h"

namespace tern {
namespace {

constexpr int kSamples = 2000;

template <int N>
Eigen::Matrix<double, N + 1, 1> powers(double u) {
  Eigen::Matrix<double, N + 1, 1> p;
  p[N] = 1.0;
  for (int i = N - 1; i >= 0; --i) p[i] = u * p[i + 1];
  return p;
}

template <int N>
void expect_partition_of_unity(const Eigen::Matrix<double, N + 1, N + 1>& basis) {
  for (int i = 0; i <= kSamples; ++i) {
    const Eigen::Matrix<double, N + 1, 1> value = basis * powers<N>(static_cast<double>(i) / kSamples);
    EXPECT_GE(value.minCoeff(), -1e-14) << "degree " << N << ", sample " << i;
    EXPECT_NEAR(value.sum(), 1.0, 1e-14) << "degree " << N << ", sample " << i;
  }
}

double simplex_volume(const Points4& v) {
  const Eigen::Matrix3d edges = v.rightCols<3>().colwise() - v.col(0);
  return std::abs(edges.determinant()) / 6.0;
}

TEST(MinvoBasis, IsNonNegativeAndSumsToOneInEveryDegree) {
  expect_partition_of_unity<3>(minvo_basis_3());
  expect_partition_of_unity<2>(minvo_basis_2());
}

TEST(MinvoBasis, IsItsOwnMirrorImageInTime) {
  for (int i = 0; i <= kSamples; ++i) {
    const double u = static_cast<double>(i) / kSamples;
    const Eigen::Vector4d forward = minvo_basis_3() * powers<3>(u);
    const Eigen::Vector4d backward = minvo_basis_3() * powers<3>(1.0 - u);
    EXPECT_LE((forward - backward.reverse()).cwiseAbs().maxCoeff(), 1e-13) << "u = " << u;
  }
}

TEST(MinvoInverse, UndoesTheBasis) {
  EXPECT_LE((minvo_basis_3() * minvo_inverse_3() - Eigen::Matrix4d::Identity()).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_LE((minvo_basis_2() * minvo_inverse_2() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(MinvoSimplex, Is2p36TimesSmallerThanBernsteinsAnd254p9TimesSmallerThanTheBSplines) {
  Rng rng(1);
  Eigen::Matrix4d bernstein;
  bernstein << -1, 3, -3, 1, 3, -6, 3, 0, -3, 3, 0, 0, 1, 0, 0, 0;
  for (int round = 0; round < 20; ++round) {
    const ClampedSpline spline(support::random_control_points(rng, 6), 1.0);
    constexpr int kInner = 2;
    const double minvo = simplex_volume(spline.minvo(kInner));
    if (minvo < 1e-4) continue;
    const PowerCubic c = spline.power(kInner);
    EXPECT_NEAR(simplex_volume(c * bernstein.inverse()) / minvo, 2.36, 0.005);
    EXPECT_NEAR(simplex_volume(spline.control_points().middleCols<4>(kInner)) / minvo, 254.9, 0.05);
  }
}

RC_GTEST_PROP(MinvoPoints, ReproduceTheCubic, (std::uint64_t seed)) {
  Rng rng(seed);
  const PowerCubic c = support::random_cubic(rng);
  const Points4 v = minvo_points(c);
  for (int i = 0; i <= 20; ++i) {
    const Eigen::Vector4d u = powers<3>(i / 20.0);
    RC_ASSERT((v * minvo_basis_3() * u - c * u).norm() < 1e-13);
  }
}

TEST(MinvoPoints, KeepTheShapeOfACurveFarFromTheOrigin) {
  Rng rng(2);
  PowerCubic c = 1e-3 * support::random_cubic(rng);
  c.col(3).setZero();
  const Points4 near = minvo_points(c);
  c.col(3).setConstant(8192.0);
  const Points4 far = minvo_points(c);
  EXPECT_LE(((far.array() - 8192.0).matrix() - near).cwiseAbs().maxCoeff(), 1e-12);
}

}  // namespace
}  // namespace tern
