// The frame that a vehicle is flown in while its estimator moves the frame of its poses.
#include "mavlink/flown_frame.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"
#include "mavlink/axes.h"

namespace tern::mavlink {
namespace {

constexpr UTime kStart{1'000'000'000};

/// A vehicle on a circle of 5 m at 2 m/s, whose estimator moves it by `jump` after a second.
struct Circling {
  OdometryOffset jump;
  FlownFrame frame;
  int resets = 0, k = 0;
  UavState shown;

  void step() {
    const double t = 0.01 * k, phase = 0.4 * t;
    shown.at = kStart + Duration::from_seconds(t);
    shown.motion.p = Vec3(5.0 * std::cos(phase), 5.0 * std::sin(phase), 1.0);
    shown.motion.v = 2.0 * Vec3(-std::sin(phase), std::cos(phase), 0.0);
    shown.yaw = wrapped(phase + 3.0);
    if (t >= 1.0) {
      resets = 1;
      shown.motion.p = jump.to_W(PointInO{shown.motion.p}).xyz;
      shown.motion.v = jump.to_W(VectorInO{shown.motion.v}).xyz;
      shown.yaw = wrapped(shown.yaw + jump.yaw);
    }
    ++k;
    frame.add(shown, resets);
  }
};

TEST(FlownFrame, FollowsAResetAtATenthOfAMetrePerSecond) {
  Rng rng(1);
  for (int n = 0; n < 20; ++n) {
    Circling vehicle;
    vehicle.jump.yaw = rng.uniform(-0.2, 0.2);
    // At (5 cos 0.4, 5 sin 0.4): the jump of the vehicle is the translation plus the turn about the origin.
    const Vec3 at_reset(5.0 * std::cos(0.4), 5.0 * std::sin(0.4), 1.0);
    const Vec3 by(rng.uniform(-0.5, 0.5), rng.uniform(-0.5, 0.5), rng.uniform(-0.3, 0.3));
    vehicle.jump.translation = at_reset + by - vehicle.jump.rotation() * at_reset;
    vehicle.step();
    UavState before = vehicle.frame.flown(vehicle.shown);
    for (int k = 1; k < 2'500; ++k) {
      vehicle.step();
      const UavState flown = vehicle.frame.flown(vehicle.shown);
      const Vec3 step = flown.motion.p - before.motion.p - 0.005 * (flown.motion.v + before.motion.v);
      ASSERT_LT(step.norm(), 0.01 * FlownFrame::kSpeed + 2e-3) << k;
      ASSERT_LT(std::abs(wrapped(flown.yaw - before.yaw - 0.004)), 0.01 * FlownFrame::kTurn + 1e-6) << k;
      before = flown;
      const MotionSample back = vehicle.frame.commanded(flown.motion);
      ASSERT_LT((back.p - vehicle.shown.motion.p).norm(), 1e-9) << "a command at the vehicle is one at the estimate";
      ASSERT_LT((back.v - vehicle.shown.motion.v).norm(), 1e-9);
      ASSERT_LT(std::abs(wrapped(vehicle.frame.commanded_yaw(flown.yaw) - vehicle.shown.yaw)), 1e-9);
    }
    EXPECT_EQ(vehicle.frame.outstanding(), 0.0);
    EXPECT_EQ(before.motion.p, vehicle.shown.motion.p) << "in the end it is the estimate";
    EXPECT_EQ(vehicle.frame.jumps(), 0);
  }
}

TEST(FlownFrame, JumpsIfMoreThanAMetreIsLeft) {
  Circling vehicle;
  vehicle.jump.translation = Vec3(0.0, 0.0, 1.2);
  for (int k = 0; k < 102; ++k) vehicle.step();
  EXPECT_EQ(vehicle.frame.jumps(), 1);
  EXPECT_EQ(vehicle.frame.flown(vehicle.shown).motion.p, vehicle.shown.motion.p);
}

TEST(FlownFrame, AddsResetsUpUntilAMetreIsLeft) {
  FlownFrame frame;
  UavState state;
  for (int n = 0; n < 4; ++n) {
    state.at = kStart + Duration{10'000 * n};
    state.motion.p.x() = 0.4 * n;
    frame.add(state, n);
    if (n == 3) continue;
    EXPECT_NEAR(frame.flown(state).motion.p.x(), 0.0, 0.01);
  }
  EXPECT_EQ(frame.jumps(), 1);
  EXPECT_EQ(frame.flown(state).motion.p, state.motion.p);
}

}  // namespace
}  // namespace tern::mavlink
