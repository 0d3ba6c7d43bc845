#include "predictor/models/singer_filter.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"
#include "predictor/models/axis_filter.h"

namespace tern {
namespace {

double worst_difference(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) { return (a - b).cwiseAbs().maxCoeff(); }

// P' = A P + P Aᵀ + G Gᵀ 2σ²/τ from P = 0, by the midpoint rule in many steps.
Eigen::Matrix3d integrated_noise(const AccelerationModel& model, double dt) {
  Eigen::Matrix3d a = Eigen::Matrix3d::Zero();
  a(0, 1) = a(1, 2) = 1.0;
  a(2, 2) = -1.0 / model.time_s;
  Eigen::Matrix3d noise = Eigen::Matrix3d::Zero();
  noise(2, 2) = 2.0 * model.sigma * model.sigma / model.time_s;
  const auto slope = [&](const Eigen::Matrix3d& p) -> Eigen::Matrix3d { return a * p + p * a.transpose() + noise; };
  const int steps = 20'000;
  const double h = dt / steps;
  Eigen::Matrix3d p = Eigen::Matrix3d::Zero();
  for (int i = 0; i < steps; ++i) {
    const Eigen::Matrix3d middle = p + 0.5 * h * slope(p);
    p += h * slope(middle);
  }
  return p;
}

TEST(Transition, SolvesTheModelsDifferentialEquation) {
  for (const double tau : {0.3, 1.5, 10.0}) {
    for (const double dt : {0.001, 0.033, 0.5, 1.5}) {
      const AccelerationModel model{2.0, tau};
      const Eigen::Matrix3d q = transition(model, dt).q;
      const Eigen::Matrix3d oracle = integrated_noise(model, dt);
      for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k) EXPECT_NEAR(q(i, k), oracle(i, k), 1e-6 * std::abs(oracle(i, k)) + 1e-20);
      }
    }
  }
}

TEST(Transition, TwoStepsMakeTheSameAsOne) {
  for (const AccelerationModel model : {AccelerationModel{2.0, 0.0}, AccelerationModel{2.0, 0.7}}) {
    SingerFilter start;
    start.state << 1.0, -2.0, 0.5;
    SingerFilter once = start, twice = start;
    once.predict(transition(model, 1.3));
    twice.predict(transition(model, 0.004));
    twice.predict(transition(model, 1.296));
    EXPECT_LT((once.state - twice.state).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_LT(worst_difference(once.covariance, twice.covariance), 1e-9);
  }
}

TEST(SingerFilter, IsTheConstantVelocityFilterWhereAccelerationIsWhite) {
  Rng rng(1);
  AxisFilter plain{1.0, 2.0, 0.5, 0.1, 3.0};
  SingerFilter singer;
  singer.state << 1.0, 2.0, 0.0;
  singer.covariance << 0.5, 0.1, 0.0, 0.1, 3.0, 0.0, 0.0, 0.0, 0.0;
  for (int i = 0; i < 100; ++i) {
    const double dt = rng.uniform(0.0, 0.2), z = rng.normal();
    plain.predict(dt, 0.49);
    singer.predict(transition({0.7, 0.0}, dt));
    EXPECT_NEAR(singer.distance2(z, 0.04), plain.distance2(z, 0.04), 1e-9);
    plain.update(z, 0.04);
    singer.update(z, 0.04);
    EXPECT_NEAR(singer.state[0], plain.x, 1e-10);
    EXPECT_NEAR(singer.state[1], plain.v, 1e-10);
    EXPECT_NEAR(singer.covariance(0, 1), plain.xv, 1e-10);
    EXPECT_NEAR(singer.covariance(1, 1), plain.vv, 1e-10);
  }
}

TEST(SingerFilter, StaysPositiveWithMeasurementsWithoutNoise) {
  SingerFilter filter;
  filter.covariance.diagonal() << 1e-8, 8.0, 1.0;
  for (int i = 0; i < 1000; ++i) {
    filter.predict(transition({1.0, 1.0}, 1.0 / 30));
    filter.update(0.001 * i, 0.0);
    const Eigen::Matrix3d& p = filter.covariance;
    EXPECT_GT(p(0, 0), 0.0);
    EXPECT_GT(p(1, 1), 0.0);
    EXPECT_GT(p(2, 2), 0.0);
    EXPECT_GT(p(0, 0) * p(1, 1), p(0, 1) * p(0, 1));
  }
}

}  // namespace
}  // namespace tern
