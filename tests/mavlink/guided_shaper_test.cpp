// The shaping of setpoints by a simulated ArduPilot in GUIDED.
#include "mavlink/sim/guided_shaper.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/random.h"

namespace tern::mavlink {
namespace {

constexpr double kStep = 0.001;
constexpr ShapingLimits kUp{1.0, 10.0};

/// A slalom that climbs and sinks: its jerk is at most 0.5·w³ level.
MotionSample slalom(double t, double w) {
  constexpr double kAmplitude = 0.5, kSpeed = 2.0, kClimb = 0.1;
  MotionSample m;
  m.p = Vec3(kSpeed * t, kAmplitude * std::sin(w * t), kClimb * std::sin(t));
  m.v = Vec3(kSpeed, kAmplitude * w * std::cos(w * t), kClimb * std::cos(t));
  m.a = Vec3(0.0, -kAmplitude * w * w * std::sin(w * t), -kClimb * std::sin(t));
  return m;
}

/// The largest distance of the shaped motion from the slalom, m.
double largest_lag(double w, const ShapingLimits& level) {
  GuidedShaper shaper;
  shaper.restart(slalom(0.0, w));
  double largest = 0.0;
  for (int k = 1; k < 15'000; ++k) {
    const MotionSample setpoint = slalom(k * kStep, w);
    largest = std::max(largest, (shaper.step(setpoint, level, kUp, kStep).p - setpoint.p).norm());
  }
  return largest;
}

TEST(GuidedShaper, FollowsWhatTurnsWithinItsJerkAndLagsBehindWhatTurnsFaster) {
  EXPECT_LT(largest_lag(2.0, {2.5, 5.0}), 0.02);
  EXPECT_GT(largest_lag(4.0, {2.5, 5.0}), 0.3) << "32 m/s3";
  EXPECT_LT(largest_lag(4.0, {16.0, 33.0}), 0.05);
}

TEST(GuidedShaper, AnAccelerationThatIsNotThatOfThePathShiftsTheMotionByItsShareOfTheSquaredGain) {
  constexpr double kAdded = 0.9;
  for (const ShapingLimits& level : {ShapingLimits{2.5, 10.0}, {16.0, 27.0}}) {
    GuidedShaper shaper;
    MotionSample setpoint{Vec3::Zero(), Vec3(3, 0, 0), Vec3(kAdded, 0, 0), Vec3::Zero()}, shaped;
    shaper.restart(setpoint);
    for (int k = 1; k < 20'000; ++k) {
      setpoint.p.x() += setpoint.v.x() * kStep;
      shaped = shaper.step(setpoint, level, kUp, kStep);
    }
    const double gain = level.jerk / level.acceleration;
    EXPECT_NEAR(shaped.p.x() - setpoint.p.x(), kAdded / (gain * gain), 0.02 / gain);
  }
}

TEST(GuidedShaper, NeverExceedsItsJerkAndComesToRestAtAPlace) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Rng rng(seed);
    const auto any = [&](double most) {
      return Vec3(rng.uniform(-most, most), rng.uniform(-most, most), rng.uniform(-most, most));
    };
    const ShapingLimits level{rng.uniform(1.0, 16.0), rng.uniform(4.0, 30.0)};
    GuidedShaper shaper;
    MotionSample before{any(3.0), any(3.0), any(3.0), Vec3::Zero()}, shaped;
    shaper.restart(before);
    const MotionSample place{any(5.0), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
    for (int k = 0; k < 60'000; ++k) {
      shaped = shaper.step(place, level, kUp, kStep);
      const Vec3 change = shaped.a - before.a;
      ASSERT_LE(change.head<2>().norm(), level.jerk * kStep + 1e-9) << seed;
      ASSERT_LE(std::abs(change.z()), kUp.jerk * kStep + 1e-9) << seed;
      before = shaped;
    }
    EXPECT_LT((shaped.p - place.p).norm(), 0.01) << seed;
    EXPECT_LT(shaped.v.norm(), 0.01) << seed;
  }
}

}  // namespace
}  // namespace tern::mavlink
