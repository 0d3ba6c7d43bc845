#include "planner/semantics/drift.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/base/random.h"
#include "core/world/thrust.h"
#include "planner/semantics/belief.h"

namespace tern {
namespace {

/// The covariance that the filter has when the light goes out: kSightedSigma. The gyroscope's bias does not wander.
Belief15 sighted() {
  Belief15::Covariance P = Belief15::Covariance::Zero();
  const SightedSigma s = kSightedSigma;
  const double tilt = s.acceleration / kGravity;
  P.diagonal().segment<3>(3).setConstant(s.velocity * s.velocity);
  P.diagonal().segment<2>(6).setConstant(tilt * tilt);
  P(11, 11) = s.acceleration * s.acceleration;
  P.diagonal().segment<2>(12).setConstant(s.rate_bias * s.rate_bias);
  InertialNoise noise;
  noise.rate_walk = 0.0;
  return {P, noise};
}

TEST(DarkVariance, IsWhatThePropagatedCovarianceSays) {
  Belief15 belief = sighted();
  const double h = 0.02;
  for (int k = 1; k <= 800; ++k) {
    belief.move(h, 0.3, Vec3::Zero());
    if (k % 50 != 0) continue;
    EXPECT_NEAR(belief.position_sigma() / std::sqrt(dark_variance(k * h)), 1.0, 0.01) << k * h;
  }
}

TEST(DarkGrowth, IsTheDerivativeOfTheVariance) {
  for (const double t : {0.1, 1.0, 4.0, 9.0, 30.0}) {
    const double d = 1e-5;
    EXPECT_NEAR(dark_growth(t), (dark_variance(t + d) - dark_variance(t - d)) / (2.0 * d), 1e-4 * dark_growth(t));
  }
}

TEST(DarkGrowth, IsThatOfItsEqualDarkTime) {
  for (const double t : {0.01, 0.3, 5.0, 59.0}) EXPECT_NEAR(equal_dark_time(dark_growth(t)), t, 1e-6);
  EXPECT_EQ(equal_dark_time(1e9), kLongestDark);
}

/// A stretch through one kind of place.
struct Stretch {
  double length, growth;
};

Drift drift_of(const std::vector<Stretch>& way, double speed, int parts = 1) {
  Drift drift;
  for (const Stretch& s : way) {
    for (int k = 0; k < parts; ++k) {
      drift.extend(s.length / parts, s.length / (parts * speed), s.growth, equal_dark_time(s.growth));
    }
  }
  return drift;
}

constexpr double kSeen = 1e-4, kDark = 1e3;

TEST(Drift, DoesNotDependOnHowAWayIsCut) {
  Rng rng(1);
  for (int k = 0; k < 100; ++k) {
    std::vector<Stretch> way;
    for (int n = 0; n < 5; ++n) {
      way.push_back({rng.uniform(0.5, 20.0), std::pow(10.0, rng.uniform(-5.0, 1.0))});
    }
    const Drift whole = drift_of(way, 5.0), cut = drift_of(way, 5.0, 7);
    EXPECT_NEAR(cut.at_goal(), whole.at_goal(), 1e-9);
    EXPECT_NEAR(cut.at_worst(), whole.at_worst(), 1e-9);
  }
}

TEST(Drift, IsTheSameFromEitherEndIfDarkStretchesLieBetweenSeenOnes) {
  const std::vector<Stretch> there{{10, kSeen}, {20, kDark}, {15, kSeen}, {8, kDark}, {5, kSeen}};
  const std::vector<Stretch> back(there.rbegin(), there.rend());
  EXPECT_NEAR(drift_of(there, 5.0).at_worst(), drift_of(back, 5.0).at_worst(), 1e-9);
  EXPECT_NEAR(drift_of(there, 5.0).at_goal(), drift_of(back, 5.0).at_goal(), 1e-9);
}

TEST(Drift, GrowsFasterTheLongerItIsDarkAndTheSlowerItIsFlown) {
  const auto worst = [](double metres, double speed) {
    return drift_of({{10, kSeen}, {metres, kDark}, {10, kSeen}}, speed).at_worst();
  };
  EXPECT_GT(worst(40, 5.0) - worst(30, 5.0), worst(30, 5.0) - worst(20, 5.0));
  EXPECT_GT(worst(30, 1.5), 4.0 * worst(30, 6.0));
  // Two lakes of 20 m are better than one of 40 m.
  EXPECT_LT(drift_of({{20, kDark}, {5, kSeen}, {20, kDark}}, 5.0).at_worst(), 0.6 * worst(40, 5.0));
}

TEST(Belief, GrowsAsTheVelocitiesThatAreSeenSay) {
  InertialNoise noise;
  noise.force = 0.01;  // a bandwidth of 1 rad/s: the filter is steady after seconds
  noise.rate = 1e-9;
  noise.rate_walk = 0.0;
  Belief15 belief(Belief15::Covariance::Zero(), noise);
  const Sight sight{0.0f, 0.0f, 0.01f, 0.01f};
  const int steps = 300;
  for (int k = 0; k < steps; ++k) {
    belief.move(kBeliefStep, 0.0, Vec3::Zero());
    belief.see(kBeliefStep, sight, 0.05, Vec3(5, 0, 0));
  }
  const double variance = belief.position_sigma() * belief.position_sigma();
  EXPECT_NEAR(variance / (steps * kBeliefStep * sighted_growth(0.01, 0.05)), 1.0, 0.15);
}

TEST(Belief, IsNeverWorseForSeeingMore) {
  Rng rng(2);
  for (int flight = 0; flight < 20; ++flight) {
    Belief15 less, more;
    for (int k = 0; k < 150; ++k) {
      const double heading = 0.3 * std::sin(0.05 * k);
      const Vec3 v = 5.0 * Vec3(std::cos(heading), std::sin(heading), 0.0);
      const auto sigma = static_cast<float>(std::pow(10.0, rng.uniform(-2.5, 1.0)));
      for (Belief15* belief : {&less, &more}) belief->move(kBeliefStep, heading, Vec3::Zero());
      less.see(kBeliefStep, {0.0f, 0.0f, sigma, sigma}, 0.05, v);
      more.see(kBeliefStep, {0.0f, 0.0f, 0.7f * sigma, 0.7f * sigma}, 0.05, v);
      ASSERT_LE(more.position_sigma(), less.position_sigma() + 1e-9);
      ASSERT_EQ(more.covariance(), more.covariance().transpose());
    }
  }
}

}  // namespace
}  // namespace tern
