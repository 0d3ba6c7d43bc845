// Velocities that follow setpoints.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "dimos/velocity_command.h"

namespace tern::dimos {
namespace {

constexpr UTime kNow{1'000'000'000};

UavState state_at(UTime at, const Vec3& p, const Vec3& v, double yaw) {
  UavState state;
  state.at = at;
  state.motion.p = p;
  state.motion.v = v;
  state.yaw = yaw;
  return state;
}

TEST(VelocityCommand, IsInTheBodysAxes) {
  const UavState vehicle = state_at(kNow, Vec3(1.0, 2.0, 3.0), Vec3::Zero(), M_PI / 2);  // x of the body is north
  const UavState setpoint = state_at(kNow, Vec3(1.0, 2.5, 3.25), Vec3(-1.0, 2.0, 0.5), M_PI / 2 + 0.1);
  FollowingGains gains;
  gains.position_per_s = 2.0;
  const auto twist = velocity_command(setpoint, vehicle, gains);
  ASSERT_TRUE(twist);
  EXPECT_NEAR(twist->linear.x, 2.0 + 2.0 * 0.5, 1e-12) << "north";
  EXPECT_NEAR(twist->linear.y, 1.0, 1e-12) << "west is left";
  EXPECT_NEAR(twist->linear.z, 0.5 + 2.0 * 0.25, 1e-12);
  EXPECT_NEAR(twist->angular.z, 0.1, 1e-12);
  UavState speeding = setpoint;
  speeding.motion.a = Vec3(0.0, 3.0, 0.0);
  gains.lead_s = 0.5;
  EXPECT_NEAR(velocity_command(speeding, vehicle, gains)->linear.x, 3.0 + 0.5 * 3.0, 1e-12) << "it lags by 0.5 s";
  gains.lateral = Lateral::Right;
  EXPECT_NEAR(velocity_command(setpoint, vehicle, gains)->linear.y, -1.0, 1e-12);
}

TEST(VelocityCommand, TurnsTheShortWay) {
  const auto twist = velocity_command(state_at(kNow, Vec3::Zero(), Vec3::Zero(), -3.0),
                                      state_at(kNow, Vec3::Zero(), Vec3::Zero(), 3.0), {});
  EXPECT_NEAR(twist->angular.z, 2.0 * M_PI - 6.0, 1e-12);
}

TEST(VelocityCommand, MovesAnOldStateOnAndIsNoneForAFarSetpoint) {
  const UavState old = state_at(kNow - Duration{100'000}, Vec3::Zero(), Vec3(2.0, 0.0, 0.0), 0.0);
  const auto twist = velocity_command(state_at(kNow, Vec3(0.2, 0.0, 0.0), Vec3(2.0, 0.0, 0.0), 0.0), old, {});
  ASSERT_TRUE(twist);
  EXPECT_NEAR(twist->linear.x, 2.0, 1e-12) << "it is where it should be";
  EXPECT_FALSE(velocity_command(state_at(kNow, Vec3(1.3, 0.0, 0.0), Vec3::Zero(), 0.0), old, {}));
  EXPECT_FALSE(velocity_command(state_at(kNow, Vec3(NAN, 0.0, 0.0), Vec3::Zero(), 0.0), old, {}));
}

/// The error of a vehicle that flies its velocities decays as e^(−k_p t).
RC_GTEST_PROP(VelocityCommand, LeadsAVehicleOntoItsSetpoint, ()) {
  const auto any = [] { return 0.01 * *rc::gen::inRange(-50, 51); };
  const Vec3 v(any(), any(), any());
  UavState vehicle = state_at(kNow, Vec3(any(), any(), any()), v, 6.0 * any());
  Vec3 setpoint = Vec3::Zero();
  FollowingGains gains;
  gains.yaw_per_s = 0.0;
  const double dt = 0.05, before = vehicle.motion.p.norm();
  for (int k = 0; k < 40; ++k) {
    const auto twist = velocity_command(state_at(vehicle.at, setpoint, v, 0.0), vehicle, gains);
    RC_ASSERT(twist.has_value());
    const Eigen::AngleAxisd R_WB(vehicle.yaw, Vec3::UnitZ());
    vehicle.motion.v = R_WB * Vec3(twist->linear.x, twist->linear.y, twist->linear.z);
    vehicle.motion.p += dt * vehicle.motion.v;
    vehicle.at = vehicle.at + Duration::from_seconds(dt);
    setpoint += dt * v;
  }
  RC_ASSERT(std::abs((vehicle.motion.p - setpoint).norm() - std::pow(1.0 - dt, 40) * before) < 1e-9);
}

}  // namespace
}  // namespace tern::dimos
