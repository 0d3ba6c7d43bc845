#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>
#include <stdexcept>
#include <thread>
#include <vector>

#include "core/splines/clamped_spline.h"
#include "tests/support/random_splines.h"

namespace tern {
namespace {

Eigen::Matrix4d reference_inner() {
  Eigen::Matrix4d m;
  // clang-format off
  m <<  0.183721899152406,    0.0570095409277783, -0.0154551557075971, -0.00533879444952182,
        0.701765225773789,    0.666573812542294,   0.291871802237524,   0.119851669523326,
        0.119851669523327,    0.291871802237524,   0.666573812542294,   0.701765225773789,
       -0.00533879444952174, -0.0154551557075971,  0.0570095409277783,  0.183721899152406;
  // clang-format on
  return m;
}

Eigen::Matrix4d reference_first() {
  Eigen::Matrix4d m;
  // clang-format off
  m <<  1.10233139491443,     0.34205724556667,   -0.0927309342455829, -0.0320327666971306,
       -0.0496835562537492,   0.657803473246772,   0.530538637601869,   0.21181027098212,
       -0.0473090442111623,   0.0155944368941556,  0.505182755715935,   0.636500596562604,
       -0.00533879444952184, -0.0154551557075971,  0.0570095409277783,  0.183721899152406;
  // clang-format on
  return m;
}

double largest(const Eigen::Matrix4d& m) { return m.cwiseAbs().maxCoeff(); }

// Expects that the support of the MINVO hull is at least that of the curve in every direction. With the normals of the
// faces this means containment.
void expect_on_one_side(const Eigen::Ref<const Points>& hull, const Vec3& x, const Vec3& direction, int j) {
  const double slack = 1e-12 * (1.0 + hull.cwiseAbs().maxCoeff());
  ASSERT_LE(direction.dot(x), (direction.transpose() * hull).maxCoeff() + slack) << "interval " << j;
}

std::array<Vec3, 4> face_normals(const Points4& v) {
  std::array<Vec3, 4> normals;
  for (int apex = 0; apex < 4; ++apex) {
    const Vec3 a = v.col((apex + 1) % 4);
    const Vec3 b = v.col((apex + 2) % 4);
    const Vec3 c = v.col((apex + 3) % 4);
    Vec3 n = (b - a).cross(c - a);
    if (n.dot(v.col(apex) - a) > 0.0) n = -n;
    normals[static_cast<std::size_t>(apex)] = n.norm() > 1e-9 ? Vec3(n.normalized()) : Vec3::Zero();
  }
  return normals;
}

TEST(SplineBasis, MatchesTheReferenceInInnerFirstAndLastIntervals) {
  for (int intervals = 4; intervals <= 12; ++intervals) {
    const SplineBasis& basis = spline_basis(intervals);
    EXPECT_LE(largest(basis.position_minvo(0) - reference_first()), 1e-12) << "J = " << intervals;
    EXPECT_LE(largest(basis.position_minvo(intervals - 1) - reference_first().reverse()), 1e-12) << "J = " << intervals;
    for (int j = 2; j < intervals - 2; ++j) {
      EXPECT_LE(largest(basis.position_minvo(j) - reference_inner()), 1e-12) << "J = " << intervals << ", j = " << j;
    }
  }
}

TEST(SplineBasis, HasItsOwnMatricesInTheTwoIntervalsAtEachEnd) {
  const SplineBasis& basis = spline_basis(8);
  for (const int j : {0, 1, 6, 7}) EXPECT_GT(largest(basis.power(j) - basis.power(3)), 0.05) << "j = " << j;
  for (int j = 0; j < 8; ++j) {
    EXPECT_LE(largest(basis.position_minvo(j) - basis.position_minvo(7 - j).reverse()), 1e-13) << "j = " << j;
  }
}

TEST(SplineBasis, ConvertersOfPositionSumToOneAndThoseOfDerivativesToZero) {
  for (int intervals = 1; intervals <= 12; ++intervals) {
    const SplineBasis& basis = spline_basis(intervals);
    for (int j = 0; j < intervals; ++j) {
      EXPECT_LE((basis.position_minvo(j).colwise().sum().array() - 1.0).abs().maxCoeff(), 1e-14);
      EXPECT_LE(basis.velocity_minvo(j).colwise().sum().cwiseAbs().maxCoeff(), 1e-13);
      EXPECT_LE(basis.velocity_bezier(j).colwise().sum().cwiseAbs().maxCoeff(), 1e-14);
      EXPECT_LE(basis.acceleration_ends(j).colwise().sum().cwiseAbs().maxCoeff(), 1e-13);
      EXPECT_NEAR(basis.jerk(j).sum(), 0.0, 1e-13);
    }
  }
}

RC_GTEST_PROP(MinvoSimplex, ContainsTheCurve, (std::uint64_t seed)) {
  Rng rng(seed);
  const ClampedSpline spline = support::random_spline(rng);
  for (int j = 0; j < spline.intervals(); ++j) {
    const Points4 v = spline.minvo(j);
    for (int i = 0; i <= 50; ++i) {
      const Vec3 p = spline.sample(std::min(spline.duration_s(), (j + i / 50.0) * spline.interval_s())).p;
      for (const Vec3& normal : face_normals(v)) expect_on_one_side(v, p, normal, j);
    }
  }
}

RC_GTEST_PROP(MinvoSimplex, ContainsTheVelocity, (std::uint64_t seed)) {
  Rng rng(seed);
  const ClampedSpline spline = support::random_spline(rng);
  for (int j = 0; j < spline.intervals(); ++j) {
    const Points4 q = spline.control_points().middleCols<4>(j);
    const Points3 minvo = q * spline.basis().velocity_minvo(j) / spline.interval_s();
    const Points3 bezier = q * spline.basis().velocity_bezier(j) / spline.interval_s();
    for (int i = 0; i <= 50; ++i) {
      const Vec3 v = spline.sample(std::min(spline.duration_s(), (j + i / 50.0) * spline.interval_s())).v;
      const Vec3 direction = support::random_vector(rng, 1.0);
      expect_on_one_side(minvo, v, direction, j);
      expect_on_one_side(bezier, v, direction, j);
    }
  }
}

RC_GTEST_PROP(SplineBasis, DerivativeRowsAgreeWithSamples, (std::uint64_t seed)) {
  Rng rng(seed);
  const ClampedSpline spline = support::random_spline(rng);
  const double dt = spline.interval_s();
  for (int j = 0; j < spline.intervals(); ++j) {
    const Points4 q = spline.control_points().middleCols<4>(j);
    const MotionSample start = spline.sample(j * dt);
    RC_ASSERT((q * spline.basis().acceleration_ends(j).col(0) - start.a * dt * dt).norm() < 1e-11);
    RC_ASSERT((q * spline.basis().jerk(j) - start.j * dt * dt * dt).norm() < 1e-11);
    RC_ASSERT((q * spline.basis().velocity_bezier(j).col(0) - start.v * dt).norm() < 1e-11);
    if (j + 1 == spline.intervals()) continue;
    const MotionSample end = spline.sample((j + 1) * dt);
    RC_ASSERT((q * spline.basis().acceleration_ends(j).col(1) - end.a * dt * dt).norm() < 1e-11);
    RC_ASSERT((q * spline.basis().velocity_bezier(j).col(2) - end.v * dt).norm() < 1e-11);
  }
}

TEST(SplineBasis, IsOneObjectForAllThreads) {
  constexpr int kIntervals = 77;  // asked for nowhere else
  std::array<const SplineBasis*, 4> seen{};
  std::vector<std::thread> threads;
  for (auto& slot : seen) threads.emplace_back([&slot] { slot = &spline_basis(kIntervals); });
  for (auto& thread : threads) thread.join();
  for (const SplineBasis* basis : seen) EXPECT_EQ(basis, &spline_basis(kIntervals));
  EXPECT_EQ(seen[0]->control_points(), kIntervals + 3);
}

TEST(SplineBasis, RefusesIntervalsOutsideItsRange) {
  EXPECT_THROW(spline_basis(0), std::invalid_argument);
  EXPECT_THROW(spline_basis(-1), std::invalid_argument);
  EXPECT_THROW(spline_basis(kMaxIntervals + 1), std::invalid_argument);
  EXPECT_NO_THROW(spline_basis(kMaxIntervals));
  EXPECT_THROW(static_cast<void>(spline_basis(4).power(4)), std::out_of_range);
  EXPECT_THROW(static_cast<void>(spline_basis(4).jerk(-1)), std::out_of_range);
}

}  // namespace
}  // namespace tern
