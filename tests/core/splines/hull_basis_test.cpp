#include "core/splines/hull_basis.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "core/splines/piecewise_cubic.h"
#include "tests/support/random_splines.h"

namespace tern {
namespace {

constexpr HullBasis kBases[] = {HullBasis::Minvo, HullBasis::Bezier, HullBasis::Bspline};
constexpr double kRounding = 1e-12;

Eigen::Vector4d powers(double u) { return {u * u * u, u * u, u, 1.0}; }

/// Returns the weights of the four hull points in the curve's point at u. The hull contains it if no weight is
/// negative.
void expect_convex(const Eigen::Vector4d& shares) {
  EXPECT_GE(shares.minCoeff(), -kRounding);
  EXPECT_NEAR(shares.sum(), 1.0, kRounding);
}

TEST(HullBasis, ItsPolynomialsAreSharesThatSumToOne) {
  for (const HullBasis basis : kBases) {
    const Eigen::Matrix4d polynomials = hull_inverse_3(basis).inverse();
    for (int k = 0; k <= 100; ++k) expect_convex(polynomials * powers(k / 100.0));
  }
}

TEST(HullBasis, AnIntervalsHullPointsHoldTheCurve) {
  Rng rng(1);
  for (int i = 0; i < 100; ++i) {
    const ClampedSpline spline = support::random_spline(rng);
    for (int j = 0; j < spline.intervals(); ++j) {
      const Points4 window = spline.control_points().middleCols<4>(j);
      for (const HullBasis basis : kBases) {
        const Eigen::Matrix4d weights = hull_of_interval(spline.basis(), basis, j);
        const Eigen::Matrix4d shares = weights.inverse() * spline.basis().power(j);
        for (int k = 0; k <= 10; ++k) expect_convex(shares * powers(k / 10.0));
        const HullForm form{basis, spline.intervals()};
        const Points4 points = form.points(j, spline.power(j), 0.0, 1.0);
        EXPECT_LE((points - window * weights).cwiseAbs().maxCoeff(), 1e-9);
      }
    }
  }
}

TEST(HullBasis, APartsHullPointsHoldThePart) {
  Rng rng(2);
  for (int i = 0; i < 200; ++i) {
    const PowerCubic cubic = support::random_cubic(rng);
    const double u0 = 0.25 * support::random_integer(rng, 0, 3);
    for (const HullBasis basis : kBases) {
      const Points4 points = HullForm{basis, 6}.points(2, cubic, u0, u0 + 0.25);
      const Eigen::Matrix4d polynomials = hull_inverse_3(basis).inverse();
      for (int k = 0; k <= 10; ++k) {
        const Vec3 on_curve = cubic * powers(u0 + 0.025 * k);
        EXPECT_LE((points * (polynomials * powers(k / 10.0)) - on_curve).norm(), 1e-9);
      }
    }
  }
}

TEST(HullBasis, TheVelocitysHullPointsHoldIt) {
  Rng rng(3);
  for (int i = 0; i < 50; ++i) {
    const ClampedSpline spline = support::random_spline(rng);
    for (int j = 0; j < spline.intervals(); ++j) {
      const Points4 window = spline.control_points().middleCols<4>(j);
      for (const HullBasis basis : kBases) {
        const Points3 hull = window * velocity_hull_of_interval(spline.basis(), basis, j) / spline.interval_s();
        for (int k = 0; k <= 10; ++k) {
          const Vec3 v = spline.sample((j + 0.1 * std::min(k, 9)) * spline.interval_s()).v;
          const Vec3 slack = 1e-9 * (Vec3::Ones() + v.cwiseAbs());
          EXPECT_TRUE(((v + slack).array() >= hull.rowwise().minCoeff().array()).all());
          EXPECT_TRUE(((v - slack).array() <= hull.rowwise().maxCoeff().array()).all());
        }
      }
    }
  }
}

/// |det| of the points is six times the simplex's volume for the curve (u³, u², u): 2.36 and 254.9 times MINVO's (its
/// paper's table).
TEST(HullBasis, MinvoIsTheTightest) {
  const double minvo = std::abs(hull_inverse_3(HullBasis::Minvo).determinant());
  EXPECT_NEAR(std::abs(hull_inverse_3(HullBasis::Bezier).determinant()) / minvo, 2.36, 0.01);
  EXPECT_NEAR(std::abs(hull_inverse_3(HullBasis::Bspline).determinant()) / minvo, 254.9, 0.1);
}

}  // namespace
}  // namespace tern
