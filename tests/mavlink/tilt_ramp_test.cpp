// A PX4 limits its tilt after take-off. The bridge follows when that is over.
#include "mavlink/tilt_ramp.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mavlink/bridge.h"
#include "tests/mavlink/flight_in_memory.h"

namespace tern::mavlink {
namespace {

using testing::HasSubstr;

constexpr double kRamp = 3.0, kRise = 33.0;  // PX4's defaults, s and degrees

TEST(TiltRamp, LastsFromTheGroundUntilTheLimitHasRisen) {
  TiltRamp ramp;
  const UTime lifted{10'000'000};
  EXPECT_EQ(ramp.remaining(kRamp, kRise, lifted), Duration{});
  ramp.add(true, lifted - Duration{1'000'000});
  EXPECT_EQ(ramp.remaining(kRamp, kRise, lifted), Duration{}) << "on the ground it is not the reason";
  ramp.add(false, lifted);
  EXPECT_NEAR(ramp.remaining(kRamp, kRise, lifted).seconds(), 3.0 + 33.0 / 11.4, 1e-5);
  ramp.add(false, lifted + Duration{1'000'000});
  EXPECT_NEAR(ramp.remaining(kRamp, kRise, lifted + Duration{1'000'000}).seconds(), 2.0 + 33.0 / 11.4, 1e-5);
  EXPECT_EQ(ramp.remaining(kRamp, kRise, lifted + Duration{6'000'000}), Duration{});
}

TEST(TiltRamp, OfAVehicleFirstSeenInTheAirIsOver) {
  TiltRamp ramp;
  ramp.add(std::nullopt, UTime{1});
  ramp.add(false, UTime{2});
  EXPECT_EQ(ramp.remaining(kRamp, kRise, UTime{3}), Duration{});
}

/// Accelerates by up to 7 m/s² (35.5° of tilt) to 5.6 m/s, as plans may.
MotionSample dash(double t) {
  constexpr double kMean = 3.5, kFor = 1.6, kOmega = 2.0 * std::numbers::pi / kFor;
  MotionSample m{Vec3(0, 0, 2), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  const double u = std::min(t, kFor);
  m.a.x() = kMean * (1.0 - std::cos(kOmega * u));
  m.j.x() = t < kFor ? kMean * kOmega * std::sin(kOmega * u) : 0.0;
  m.v.x() = kMean * (u - std::sin(kOmega * u) / kOmega);
  m.p.x() = kMean * (0.5 * u * u + (std::cos(kOmega * u) - 1.0) / (kOmega * kOmega)) + m.v.x() * (t - u);
  return m;
}

/// The largest distance from the dash's setpoints in its first 3 s.
double farthest_off(FlightInMemory& flight) {
  flight.path = dash;
  double most = 0.0;
  flight.each = [&] {
    if (!flight.follows_since) return;
    const Vec3 commanded = dash((flight.now - *flight.follows_since).seconds()).p;
    most = std::max(most, (flight.autopilot.model().truth().motion.p - commanded).norm());
  };
  flight.run(3.0);
  flight.each = nullptr;
  return most;
}

TEST(TiltRamp, TheSimulatedAutopilotTiltsNoFartherThanItsLandingLimitAtFirst) {
  FlightInMemory flight;
  ASSERT_TRUE(flight.run_until([&] { return flight.autopilot.model().truth().motion.p.z() > 0.3; }));
  flight.bridge_runs = false;  // this test flies: to the side, at once
  double tilt = 0.0;
  const auto fly_aside = [&](double seconds) {
    tilt = 0.0;
    for (int k = 0; k < static_cast<int>(seconds / 0.02); ++k) {
      const SetPositionTargetLocalNed target{.p = {0, 50, -2},
                                             .v = {0, 6, 0},
                                             .a = {0, 9, 0},
                                             .type_mask = 0x0800,
                                             .target_system = 1,
                                             .coordinate_frame = 1};
      flight.autopilot.receive(to_frame(target, {1, 191}, 0), flight.now);
      flight.run(0.02);
      const Vec3 up = flight.autopilot.model().truth().q * Vec3::UnitZ();
      tilt = std::max(tilt, std::acos(up.z()) * 180.0 / std::numbers::pi);
    }
  };
  fly_aside(1.0);
  EXPECT_LT(tilt, 14.0);
  fly_aside(6.0);
  EXPECT_GT(tilt, 30.0);
}

TEST(TiltRamp, TheVehicleFollowsWhenItCanTiltAsPlansDo) {
  const BridgeConfig bridge{.start = Start::Arm, .set_parameters = true};
  SimulatedAutopilotConfig known_drag;
  known_drag.quadrotor.body.drag_per_s = known_drag.quadrotor.body.drag_up_per_s = bridge.drag_per_s;
  known_drag.quadrotor.body.drag_per_m = 0.0;
  FlightInMemory flight(bridge, known_drag);
  ASSERT_TRUE(flight.run_until([&] { return flight.bridge.stage() == Stage::Following; }));
  EXPECT_THAT(flight.bridge.status(flight.now).why_not, HasSubstr("its tilt is still limited after take-off, for "));
  ASSERT_TRUE(flight.run_until([&] { return flight.following(); }));
  EXPECT_NEAR(flight.autopilot.model().truth().motion.p.z(), 2.0, 0.1);
  EXPECT_LT(farthest_off(flight), 0.2) << "0.5 m if it follows at once";
}

TEST(TiltRamp, ABridgeThatIsRestartedInFlightFollowsAtOnce) {
  FlightInMemory flight;
  ASSERT_TRUE(flight.run_until([&] { return flight.following(); }));
  flight.bridge = Bridge(flight.config, FlightInMemory::uav(), flight.now);
  EXPECT_TRUE(flight.run_until([&] { return flight.following(); }, 4.0)) << flight.bridge.status(flight.now).why_not;
}

TEST(TiltRamp, AnArduPilotHasNone) {
  SimulatedAutopilotConfig copter;
  copter.manners = Manners::ArduPilot;
  FlightInMemory flight({.start = Start::Arm, .set_parameters = true}, copter);
  ASSERT_TRUE(flight.run_until([&] { return flight.bridge.stage() == Stage::Following; }));
  EXPECT_TRUE(flight.run_until([&] { return flight.following(); }, 0.2)) << flight.bridge.status(flight.now).why_not;
}

}  // namespace
}  // namespace tern::mavlink
