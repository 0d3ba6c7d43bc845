#include "simulator/vehicle/flight_controller.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "simulator/vehicle/quadrotor_model.h"

namespace tern {
namespace {

constexpr double kDt = 1e-3;

struct Loop {
  explicit Loop(QuadrotorClass kind = QuadrotorClass::Camera)
      : body(quadrotor_spec(kind)),
        gains(QuadrotorConfig::controller_for(kind, body)),
        state(hovering(body, Vec3::Zero(), 0.0)) {}

  /// Flies `command` for this time, and calls `look` after each step.
  void fly(
      const FlightCommand& command, double seconds, const std::function<void()>& look = [] {}) {
    for (int k = 0; k < static_cast<int>(std::lround(seconds / kDt)); ++k) {
      const FlightEstimate estimate{state.p, state.v, acceleration(body, state, wind), state.q, state.w};
      state = step(body, state, controller.update(command, estimate, kDt), wind,
                   -std::numeric_limits<double>::infinity(), kDt);
      look();
    }
  }

  QuadrotorSpec body;
  FlightControllerSpec gains;
  FlightController controller{body, gains};
  QuadrotorState state;
  Vec3 wind = Vec3::Zero();
};

FlightCommand hold(const Vec3& p, double yaw = 0.0) {
  FlightCommand command;
  command.motion.p = p;
  command.yaw = yaw;
  return command;
}

TEST(FlightController, AStepOfOneMetreArrivesWithLittleOvershoot) {
  for (const auto kind : {QuadrotorClass::Camera, QuadrotorClass::Racer}) {
    Loop loop(kind);
    double farthest = 0.0;
    loop.fly(hold(Vec3(1, 0, 0)), 2.0, [&] { farthest = std::max(farthest, loop.state.p.x()); });
    EXPECT_NEAR(loop.state.p.x(), 1.0, 0.1);
    EXPECT_LT(farthest, 1.15);
    loop.fly(hold(Vec3(1, 0, 0)), 8.0);
    EXPECT_LT((loop.state.p - Vec3(1, 0, 0)).norm(), 1e-2);
  }
}

TEST(FlightController, HoldsItsPlaceInSteadyWind) {
  Loop loop;
  loop.wind = Vec3(8.0, 4.0, 0.0);
  loop.fly(hold(Vec3::Zero()), 20.0);
  EXPECT_LT(loop.state.p.norm(), 1e-2);
}

TEST(FlightController, TurnsToTheHeadingTheShortWay) {
  Loop loop;
  loop.state = hovering(loop.body, Vec3::Zero(), 3.0);
  double least = 3.2;
  loop.fly(hold(Vec3::Zero(), -3.0), 4.0, [&] {
    const Vec3 x = loop.state.q * Vec3::UnitX();
    least = std::min(least, std::abs(std::atan2(x.y(), x.x())));
  });
  const Vec3 x = loop.state.q * Vec3::UnitX();
  EXPECT_NEAR(std::atan2(x.y(), x.x()), -3.0, 1e-2);
  EXPECT_GT(least, 2.9);
}

TEST(FlightController, TiltsNoFartherThanItMay) {
  Loop loop;
  loop.gains.tilt_max = 0.5;
  loop.controller = FlightController(loop.body, loop.gains);
  double least_up = 1.0;
  loop.fly(hold(Vec3(50, -50, 0)), 5.0, [&] { least_up = std::min(least_up, (loop.state.q * Vec3::UnitZ()).z()); });
  EXPECT_LT(least_up, std::cos(0.4));
  EXPECT_GT(least_up, std::cos(0.58));
}

TEST(FlightController, KeepsItsHeightWhenMoreIsAskedThanTheRotorsHave) {
  Loop loop;
  double lowest = 0.0;
  loop.fly(hold(Vec3(500, 0, 0)), 5.0, [&] { lowest = std::min(lowest, loop.state.p.z()); });
  EXPECT_GT(lowest, -1.0);
}

TEST(FlightController, ADTermLagsBehindAConstantAcceleration) {
  // a·(1 + D) is what must be sent (docs/reference/autopilot.md).
  FlightCommand command;
  for (const double sent : {1.0, 1.2}) {
    Loop loop;
    loop.gains = {.position_p = 0.0, .velocity_p = 0.0, .velocity_i = 0.0, .velocity_d = 0.2};
    loop.body.drag_per_s = loop.body.drag_per_m = 0.0;
    loop.controller = FlightController(loop.body, loop.gains);
    command.motion.a = Vec3(sent, 0, 0);
    loop.fly(command, 1.0);
    const double before = loop.state.v.x();
    loop.fly(command, 1.0);
    EXPECT_NEAR(loop.state.v.x() - before, sent / 1.2, 1e-2);
  }
}

TEST(FlightController, FollowsBackwardsFlightUpsideDownOfNothing) {
  // Any commanded acceleration, also straight down beyond free fall, gives finite rotors within limits.
  Loop loop;
  FlightCommand command;
  command.motion.a = Vec3(0, 0, -30.0);
  loop.fly(command, 3.0);
  EXPECT_TRUE(loop.state.p.allFinite());
  loop.fly(hold(loop.state.p), 6.0);
  EXPECT_LT(loop.state.v.norm(), 0.2);
}

/// A smooth pulse: 1 between two times.
double between(double t, double from, double to) {
  constexpr double kRamp = 0.2;
  return std::clamp((t - from) / kRamp, 0.0, 1.0) - std::clamp((t - to) / kRamp, 0.0, 1.0);
}

/// Up and down at 4 m/s². On the way down the jerk changes its direction every 0.1 s, as that of plans may.
Vec3 restless(double t) {
  constexpr double kJerk = 50.0, kHalf = 0.1, kUp = 4.0;
  Vec3 a(0, 0, kUp * (between(t, 0.0, 0.6) - between(t, 0.8, 2.0) + between(t, 2.2, 2.8)));
  if (t < 1.0 || t > 2.0) return a;
  const double w = std::fmod(t - 1.0, 4.0 * kHalf);
  const double y = w < kHalf ? w : w < 3.0 * kHalf ? 2.0 * kHalf - w : w - 4.0 * kHalf;
  a.head<2>() = kJerk * Eigen::Vector2d(0.7 * y, y);
  return a;
}

TEST(FlightController, WhoTurnsToAndFroAtLittleThrustIsNotLifted) {
  Loop loop(QuadrotorClass::Racer);
  loop.wind = Vec3(0, 8, 0);
  loop.fly(hold(Vec3::Zero()), 4.0);
  FlightCommand command;
  double highest = 0.0;
  for (double t = 0.0; t < 4.0; t += kDt) {
    MotionSample& m = command.motion;
    m.a = restless(t);
    m.j = (restless(t + loop.gains.lead_s) - m.a) / loop.gains.lead_s;
    loop.fly(command, kDt);
    m.p += kDt * m.v + 0.5 * kDt * kDt * m.a;
    m.v += kDt * m.a;
    highest = std::max(highest, loop.state.p.z() - m.p.z());
  }
  EXPECT_LT(highest, 0.1) << "without a bound on what torque may lift it, it is 0.46 m";
}

}  // namespace
}  // namespace tern
