#include "executor/yaw_follower.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/random.h"
#include "core/world/thrust.h"

namespace tern {
namespace {

constexpr UTime kZero{1'700'000'000'000'000};
constexpr Duration kStep{10'000};

double apart(double a, double b) { return std::abs(std::remainder(a - b, 2.0 * M_PI)); }
Vec3 flying(double yaw, double speed = 3.0) { return {speed * std::cos(yaw), speed * std::sin(yaw), 1.0}; }

TEST(YawFollower, NeverTurnsFasterNorSpeedsUpMoreThanItMayWhateverTheFlightDoes) {
  Rng rng(3);
  for (int round = 0; round < 50; ++round) {
    YawFollowerConfig config;
    config.rate_max_deg_s = rng.uniform(20.0, 400.0);
    config.acceleration_max_deg_s2 = rng.uniform(50.0, 2000.0);
    YawFollower heading(rng.uniform(-4.0, 4.0), kZero, config);
    UTime now = kZero;
    double yaw = heading.yaw();
    double rate = 0.0;
    for (int k = 0; k < 400; ++k) {
      const Duration step{static_cast<std::int64_t>(rng.uniform(1'000.0, 30'000.0))};
      now = now + step;
      const double at = heading.follow(flying(rng.uniform(-7.0, 7.0), rng.uniform(0.0, 5.0)), now);
      const double h = step.seconds();
      ASSERT_LE(std::abs(at), M_PI);
      ASSERT_NEAR(std::remainder(at - yaw, 2.0 * M_PI), heading.rate() * h, 1e-12);
      ASSERT_LE(std::abs(heading.rate()), to_radians(config.rate_max_deg_s) + 1e-12);
      ASSERT_LE(std::abs(heading.rate() - rate), to_radians(config.acceleration_max_deg_s2) * h + 1e-12);
      yaw = at;
      rate = heading.rate();
    }
  }
}

TEST(YawFollower, ReachesASteadyFlightsDirectionTheShorterWayInTheLeastTimeAndStaysThere) {
  const YawFollowerConfig config;
  const double v = to_radians(config.rate_max_deg_s);
  const double a = to_radians(config.acceleration_max_deg_s2);
  for (const double from : {0.0, 1.0, 3.0, -2.0}) {
    for (const double to : {0.1, 1.5, -3.1, 3.0}) {
      YawFollower heading(from, kZero, config);
      const double way = apart(from, to);
      const double least_s = way < v * v / a ? 2.0 * std::sqrt(way / a) : way / v + v / a;
      UTime now = kZero;
      double turned = 0.0;
      while ((now - kZero).seconds() < least_s + 0.1) {
        now = now + kStep;
        heading.follow(flying(to), now);
        turned += std::abs(heading.rate()) * kStep.seconds();
      }
      EXPECT_LT(apart(heading.yaw(), to), 0.01) << from << " to " << to;
      EXPECT_LT(turned, way + 0.01) << "overshot, or went the longer way: " << from << " to " << to;
      for (int k = 0; k < 100; ++k) heading.follow(flying(to), now = now + kStep);
      EXPECT_LT(apart(heading.yaw(), to), 1e-6);
      EXPECT_LT(std::abs(heading.rate()), 1e-6);
    }
  }
}

TEST(YawFollower, OfAVehicleThatHoversKeepsItsLastAim) {
  YawFollower heading(0.0, kZero);
  UTime now = kZero;
  for (int k = 0; k < 10; ++k) heading.follow(flying(1.0), now = now + kStep);
  for (int k = 0; k < 300; ++k) heading.follow(flying(-2.0, 0.1), now = now + kStep);
  EXPECT_NEAR(heading.yaw(), 1.0, 1e-6);
}

TEST(YawFollower, ATimeThatHasPassedChangesNothing) {
  YawFollower heading(0.5, kZero);
  EXPECT_EQ(heading.follow(flying(2.0), kZero), 0.5);
  EXPECT_EQ(heading.rate(), 0.0);
}

}  // namespace
}  // namespace tern
