#include <gtest/gtest.h>

#include <cmath>

#include "simulator/vehicle/estimator.h"
#include "simulator/vehicle/wind.h"

namespace tern {
namespace {

constexpr double kDt = 1e-2;

TEST(Wind, WithoutGustsIsTheMean) {
  WindSpec spec{.speed = 8.0, .towards = 1.0, .gusts = 0.0};
  Wind wind(spec, 1);
  wind.advance(5.0, kDt);
  EXPECT_LT((wind.velocity() - Vec3(8.0 * std::cos(1.0), 8.0 * std::sin(1.0), 0.0)).norm(), 1e-12);
}

TEST(Wind, GustsHaveDrydensDeviationAndLength) {
  const WindSpec spec{.speed = 8.0};
  const Turbulence expected = turbulence_of(spec);
  Wind wind(spec, 1);
  Vec3 squares = Vec3::Zero();
  double product = 0.0;
  const double airspeed = 8.0;
  const int lag = static_cast<int>(expected.length.x() / airspeed / kDt);
  std::vector<double> along;
  constexpr int kSteps = 2'000'000;  // some 3600 correlation times of the slowest
  for (int k = 0; k < kSteps; ++k) {
    wind.advance(airspeed, kDt);
    const Vec3 gust = wind.velocity() - Vec3(8.0, 0.0, 0.0);
    squares += gust.cwiseAbs2();
    along.push_back(gust.x());
  }
  for (std::size_t k = static_cast<std::size_t>(lag); k < along.size(); ++k) {
    product += along[k] * along[k - static_cast<std::size_t>(lag)];
  }
  const Vec3 sigma = (squares / kSteps).cwiseSqrt();
  // σ of a variance estimate from n independent values is σ²√(2/n): 5 % is three of it.
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(sigma[k], expected.sigma[k], 0.05 * expected.sigma[k]) << k;
  EXPECT_NEAR(product / static_cast<double>(along.size()) / (sigma.x() * sigma.x()), std::exp(-1.0), 0.08);
}

TEST(Wind, TurbulenceAtSixMetresIsThatOfTheStandard) {
  const Turbulence t = turbulence_of({.speed = 8.0});
  EXPECT_NEAR(t.sigma.z(), 0.8, 1e-12);
  EXPECT_NEAR(t.sigma.x(), 0.8 / std::pow(0.177 + 0.000823 * 6.1 / 0.3048, 0.4), 1e-12);
  EXPECT_GT(t.length.x(), 40.0);
  EXPECT_LT(t.length.x(), 50.0);
}

TEST(Wind, ABurstPeaksInItsMiddleAndIsOver) {
  Wind wind({.burst = 15.0, .burst_at_s = 1.0, .burst_lasts_s = 2.0}, 1);
  double peak = 0.0, peak_at = 0.0;
  for (int k = 1; k <= 400; ++k) {
    wind.advance(1.0, kDt);
    if (wind.velocity().x() > peak) peak = wind.velocity().x(), peak_at = k * kDt;
  }
  EXPECT_NEAR(peak, 15.0, 1e-2);
  EXPECT_NEAR(peak_at, 2.0, 2e-2);
  EXPECT_EQ(wind.velocity(), Vec3::Zero());
}

TEST(EstimateNoise, WithoutErrorsKnowsTheTruth) {
  EstimateNoise estimator({}, 1);
  for (int k = 0; k < 100; ++k) estimator.advance(kDt);
  EXPECT_EQ(estimator.position_error(), Vec3::Zero());
  EXPECT_EQ(estimator.velocity_error(), Vec3::Zero());
  EXPECT_EQ(estimator.jumps(), 0);
}

TEST(EstimateNoise, ErrorsHaveTheStatedDeviations) {
  EstimateNoise estimator({.position_sigma_m = 0.03, .velocity_sigma = 0.1, .drift_m = 0.2, .drift_time_s = 1.0}, 2);
  Vec3 position = Vec3::Zero(), velocity = Vec3::Zero();
  constexpr int kSteps = 400'000;
  for (int k = 0; k < kSteps; ++k) {
    estimator.advance(kDt);
    position += estimator.position_error().cwiseAbs2();
    velocity += estimator.velocity_error().cwiseAbs2();
  }
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(std::sqrt(position[k] / kSteps), std::hypot(0.03, 0.2), 0.02);
    EXPECT_NEAR(std::sqrt(velocity[k] / kSteps), 0.1, 0.01);
  }
}

TEST(EstimateNoise, JumpsOnceWhenTold) {
  EstimateNoise estimator({.jump_m = 0.6, .jump_at_s = 1.0}, 3);
  for (int k = 0; k < 99; ++k) estimator.advance(kDt);
  EXPECT_EQ(estimator.jumps(), 0);
  for (int k = 0; k < 2; ++k) estimator.advance(kDt);
  EXPECT_EQ(estimator.jumps(), 1);
  EXPECT_NEAR(estimator.position_error().norm(), 0.6, 1e-12);
  EXPECT_EQ(estimator.position_error().z(), 0.0);
  for (int k = 0; k < 1000; ++k) estimator.advance(kDt);
  EXPECT_EQ(estimator.jumps(), 1);
}

TEST(EstimateNoise, JumpsAsOftenAsStated) {
  EstimateNoise estimator({.jump_m = 0.1, .jump_every_s = 2.0}, 4);
  for (int k = 0; k < 400'000; ++k) estimator.advance(kDt);
  EXPECT_NEAR(estimator.jumps(), 2000, 3 * std::sqrt(2000.0));
}

}  // namespace
}  // namespace tern
