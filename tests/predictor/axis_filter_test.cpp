#include "predictor/models/axis_filter.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <vector>

#include "core/base/random.h"

namespace tern {
namespace {

struct Measurement {
  double dt, z, r;  // dt since the previous one
};

std::vector<Measurement> random_measurements(Rng& rng, int n) {
  std::vector<Measurement> all;
  double t = 0.0;
  for (int i = 0; i < n; ++i) {
    const double dt = rng.uniform(0.01, 0.2);
    t += dt;
    all.push_back({dt, 3.0 + 1.5 * t + 0.3 * rng.normal(), rng.uniform(0.01, 0.1)});
  }
  return all;
}

// Oracle: all states at once. Unknowns (x_k, v_k), k = 0 … n; the normal equations of prior, motion and measurements.
AxisFilter batch_least_squares(const AxisFilter& prior, const std::vector<Measurement>& measurements, double q) {
  const auto n = static_cast<Eigen::Index>(2 * (measurements.size() + 1));
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n);
  Eigen::Matrix2d p0;
  p0 << prior.xx, prior.xv, prior.xv, prior.vv;
  information.topLeftCorner<2, 2>() += p0.inverse();
  right.head<2>() += p0.inverse() * Eigen::Vector2d(prior.x, prior.v);
  for (std::size_t i = 0; i < measurements.size(); ++i) {
    const auto [dt, z, r] = measurements[i];
    const auto k = static_cast<Eigen::Index>(2 * i);
    Eigen::Matrix2d noise;
    noise << dt * dt * dt / 3.0, dt * dt / 2.0, dt * dt / 2.0, dt;
    Eigen::Matrix<double, 2, 4> residual;  // state k+1 − F state k
    residual << -1.0, -dt, 1.0, 0.0, 0.0, -1.0, 0.0, 1.0;
    information.block<4, 4>(k, k) += residual.transpose() * (q * noise).inverse() * residual;
    information(k + 2, k + 2) += 1.0 / r;
    right(k + 2) += z / r;
  }
  const Eigen::MatrixXd covariance = information.ldlt().solve(Eigen::MatrixXd::Identity(n, n));
  const Eigen::VectorXd state = covariance * right;
  return {state(n - 2), state(n - 1), covariance(n - 2, n - 2), covariance(n - 2, n - 1), covariance(n - 1, n - 1)};
}

void expect_near(const AxisFilter& a, const AxisFilter& b, double tolerance) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.v, b.v, tolerance);
  EXPECT_NEAR(a.xx, b.xx, tolerance);
  EXPECT_NEAR(a.xv, b.xv, tolerance);
  EXPECT_NEAR(a.vv, b.vv, tolerance);
}

TEST(AxisFilter, AgreesWithLeastSquaresOverAllStates) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng(seed);
    const double q = rng.uniform(0.1, 5.0);
    const AxisFilter prior{rng.normal(), rng.normal(), 0.5, 0.1, 2.0};
    const std::vector<Measurement> measurements = random_measurements(rng, 20);
    AxisFilter filter = prior;
    for (const Measurement& m : measurements) {
      filter.predict(m.dt, q);
      filter.update(m.z, m.r);
    }
    expect_near(filter, batch_least_squares(prior, measurements, q), 1e-8);
  }
}

TEST(AxisFilter, TwoStepsEqualOne) {
  const AxisFilter start{1.0, -2.0, 0.3, 0.1, 0.7};
  AxisFilter once = start, twice = start;
  once.predict(0.75, 1.3);
  twice.predict(0.25, 1.3);
  twice.predict(0.5, 1.3);
  expect_near(once, twice, 1e-14);
}

TEST(AxisFilter, StaysPositiveWithMeasurementsWithoutNoise) {
  AxisFilter filter{0.0, 0.0, kMinVariance, 0.0, 8.0};
  for (int i = 1; i <= 3000; ++i) {
    filter.predict(1.0 / 30, 1e-4);
    filter.update(0.01 * i, 0.0);
    ASSERT_GT(filter.xx, 0.0);
    ASSERT_GT(filter.xx * filter.vv, filter.xv * filter.xv);
  }
  EXPECT_NEAR(filter.v, 0.3, 1e-6);
}

TEST(Fit, ItsDistanceHasTheMeanOfChiSquare) {
  Rng rng(7);
  const auto noise = [&rng] { return Vec3(rng.normal(), rng.normal(), rng.normal()); };
  const Vec3 x(2.0, -1.0, 0.5);
  double sum = 0.0;
  const int trials = 20'000;
  for (int i = 0; i < trials; ++i) {
    const Vec3 truth = x + 0.3 * noise();
    sum += fit(x, Vec3::Constant(0.09), truth + 0.1 * noise(), Vec3::Constant(0.01)).distance2;
  }
  EXPECT_NEAR(sum / trials, 3.0, 0.07);  // deviation of the mean: √(6/20000) = 0.017
}

TEST(Fit, ItsCostIsTheNegativeLogarithmOfTheDensity) {
  Rng rng(1);
  const auto log_density = [](const Vec3& error, const Vec3& s) {
    double density = 1.0;
    for (int i = 0; i < 3; ++i) density *= std::exp(-0.5 * error[i] * error[i] / s[i]) / std::sqrt(s[i]);
    return std::log(density);
  };
  const Vec3 z = Vec3::Zero(), r = Vec3::Constant(0.01);
  for (int k = 0; k < 100; ++k) {
    const Vec3 x(rng.normal(), rng.normal(), rng.normal()), y(rng.normal(), rng.normal(), rng.normal());
    const Vec3 of_x = Vec3::Constant(rng.uniform(0.1, 2.0)), of_y = Vec3::Constant(rng.uniform(0.1, 2.0));
    EXPECT_NEAR(fit(x, of_x, z, r).neg_log_likelihood() - fit(y, of_y, z, r).neg_log_likelihood(),
                -2.0 * (log_density(x, of_x + r) - log_density(y, of_y + r)), 1e-9);
  }
}

TEST(Fit, ItsGateBoxContainsTheGateAndLittleMore) {
  Rng rng(3);
  const auto any = [&](double least, double most) {
    return Vec3(rng.uniform(least, most), rng.uniform(least, most), rng.uniform(least, most));
  };
  int within = 0;
  for (int n = 0; n < 20'000; ++n) {
    const Vec3 x = any(-100, 100), variance = any(1e-8, 2), most = any(0, 1), r = most.cwiseProduct(any(0, 1));
    const Vec3 z = x + 6.0 * any(-1, 1);
    const double gate = rng.uniform(1, 30);
    const Box box = gate_box(x, variance, gate, most);
    if (fit(x, variance, z, r).distance2 <= gate) {
      ++within;
      EXPECT_TRUE(box.contains(z)) << n;
    }
    const Vec3 corner = box.max() - x;
    EXPECT_NEAR(fit(x, variance, x + Vec3(corner.x(), 0, 0), most).distance2, gate, 1e-6 * gate) << n;
  }
  EXPECT_GT(within, 2'000);
}

}  // namespace
}  // namespace tern
