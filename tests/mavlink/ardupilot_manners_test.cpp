// An ArduPilot copter takes off only by command: from its source (mode_guided, takeoff, AP_Arming_Copter).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mavlink/bridge.h"
#include "tests/mavlink/flight_in_memory.h"

namespace tern::mavlink {
namespace {

using testing::HasSubstr;

SimulatedAutopilotConfig copter() {
  SimulatedAutopilotConfig config;
  config.manners = Manners::ArduPilot;
  return config;
}
const BridgeConfig kArms{.start = Start::Arm, .set_parameters = true};
CommandLong switch_to(float custom) { return {.param = {1, custom}, .command = kDoSetMode}; }

TEST(ArduPilotManners, ItTakesOffByCommandFollowsFromItsHeightAndLands) {
  FlightInMemory flight(kArms, copter());
  ASSERT_TRUE(flight.run_until([&] { return flight.following(); })) << flight.bridge.status(flight.now).why_not;
  EXPECT_EQ(flight.autopilot.mode(), "GUIDED");
  EXPECT_LT((flight.autopilot.model().truth().motion.p - Vec3(0, 0, 2)).norm(), 0.35) << "world time begins here";
  flight.path = along;
  flight.run(6.0);
  ASSERT_TRUE(flight.following()) << flight.bridge.status(flight.now).why_not;
  EXPECT_LT(
      (flight.autopilot.model().truth().motion.p - along((flight.now - *flight.follows_since).seconds()).p).norm(),
      0.3);
  flight.bridge.land("the flight has ended");
  ASSERT_TRUE(flight.run_until([&] { return flight.bridge.stage() == Stage::Landed; }));
  EXPECT_TRUE(flight.autopilot.model().truth().on_ground);
  EXPECT_FALSE(flight.autopilot.armed());
}

TEST(ArduPilotManners, AStraightFlightIsNotAheadOfItsSetpointsForAnAccelerationAgainstDrag) {
  static constexpr double kSpeed = 3.0, kDuring = 4.0;
  UavSpec uav = FlightInMemory::uav();
  uav.limits.j_max = Vec3(15, 15, 10);
  FlightInMemory flight(kArms, copter());
  flight.set_parameter("ATC_ACC_R_MAX", 1100.0F);
  flight.set_parameter("WP_ACC", 16.0F);  // its shaping corrects slowly: 22/16 per second
  flight.bridge = Bridge(kArms, uav, flight.now);
  ASSERT_TRUE(flight.run_until([&] { return flight.following(); })) << flight.bridge.status(flight.now).why_not;
  flight.path = [](double t) {
    MotionSample m{Vec3(0, 0, 2), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
    const double s = std::min(t, kSpeed);
    m.p.x() = 0.5 * s * s + kSpeed * (t - s);
    m.v.x() = s;
    m.a.x() = t < kSpeed ? 1.0 : 0.0;
    return m;
  };
  flight.run(10.0);
  double ahead = 0.0;
  int n = 0;
  flight.each = [&] {
    const double commanded = flight.path((flight.now - *flight.follows_since).seconds()).p.x();
    ahead += flight.autopilot.model().truth().motion.p.x() - commanded;
    ++n;
  };
  flight.run(kDuring);
  EXPECT_NEAR(ahead / n, 0.0, 0.1);
}

TEST(ArduPilotManners, PlansWhoseJerkItsOwnAccelerationDoesNotAllowAreNotFlown) {
  UavSpec uav = FlightInMemory::uav();
  uav.limits.j_max = Vec3(15, 15, 10);
  FlightInMemory flight(kArms, copter());
  flight.set_parameter("ATC_ACC_R_MAX", 1100.0F);
  flight.bridge = Bridge(kArms, uav, flight.now);
  flight.run(10.0);
  EXPECT_FALSE(flight.autopilot.armed());
  EXPECT_EQ(flight.bridge.status(flight.now).why_not,
            "uav.limits.j_max (x and y together) is 21.21, but WP_ACC is 2.5 (allows 10.85): 9.76 would fit");
}

TEST(ArduPilotManners, SetpointsThatCeaseLeaveItInGuidedWhereTheLastOneWas) {
  FlightInMemory flight(kArms, copter());
  ASSERT_TRUE(flight.run_until([&] { return flight.following(); }));
  flight.path = along;
  flight.run(6.0);
  const Vec3 last = along((flight.now - *flight.follows_since).seconds()).p;
  flight.bridge_runs = false;
  flight.run(8.0);
  EXPECT_EQ(flight.autopilot.mode(), "GUIDED");
  const MotionSample rest = flight.autopilot.model().truth().motion;
  EXPECT_LT(rest.v.norm(), 0.1);
  EXPECT_NEAR(rest.p.x() - last.x(), 2.0 * 0.5, 0.3) << "GUID_TIMEOUT at 2 m/s";
}

TEST(ArduPilotManners, ItsHeightIsToldAboveHomeWhereverThatIs) {
  for (const float up : {-3.0F, 1.0F}) {
    FlightInMemory flight(kArms, copter());
    flight.set_parameter("SIM_HOME_UP", up);
    ASSERT_TRUE(flight.run_until([&] { return flight.following(); })) << flight.bridge.status(flight.now).why_not;
    EXPECT_NEAR(flight.autopilot.model().truth().motion.p.z(), 2.0, 0.35) << up;
  }
}

TEST(ArduPilotManners, APilotWhoSwitchesWhileItTakesOffHasTheVehicle) {
  FlightInMemory flight(kArms, copter());
  ASSERT_TRUE(flight.run_until([&] { return flight.autopilot.model().truth().motion.p.z() > 0.8; }));
  ASSERT_EQ(flight.bridge.stage(), Stage::Engaging);
  flight.ground_station(switch_to(5));
  flight.each = [&] { ASSERT_EQ(flight.autopilot.mode(), "LOITER"); };
  flight.run(5.0);
  EXPECT_EQ(flight.bridge.stage(), Stage::StoodBack);
  EXPECT_THAT(flight.bridge.status(flight.now).why_not, HasSubstr("armed in LOITER: another pilot flies"));
}

TEST(ArduPilotManners, WithStartPilotItIsTakenUpWhenThePilotArmsInGuidedAndFollowedAgainAfterTheSwitch) {
  FlightInMemory flight({.start = Start::Pilot, .set_parameters = true}, copter());
  bool told = false;
  flight.sent = [&](const Frame& frame) { told = told || frame.id == SetPositionTargetLocalNed::kId; };
  flight.run(6.0);
  flight.ground_station(switch_to(4));
  flight.ground_station({.param = {1}, .command = kArmDisarm});
  ASSERT_TRUE(flight.run_until([&] { return flight.autopilot.model().truth().motion.p.z() > 1.5; }));
  EXPECT_FALSE(told) << "setpoints would end the take-off";
  ASSERT_TRUE(flight.run_until([&] { return flight.following(); }));
  flight.ground_station(switch_to(5));
  ASSERT_TRUE(flight.run_until([&] { return flight.bridge.stage() == Stage::StoodBack; }));
  told = false;
  flight.run(3.0);
  EXPECT_FALSE(told);
  flight.ground_station(switch_to(4));
  EXPECT_TRUE(flight.run_until([&] { return flight.following(); }));
}

TEST(ArduPilotManners, ABridgeStartedAnewDoesNotEndTheTakeOffThatItFinds) {
  constexpr double kTarget = 2.0;  // m; the take-off itself overshoots by 0.15 m
  for (const double height : {-1.0, 0.4, 1.0, 1.5}) {
    FlightInMemory flight(kArms, copter());
    ASSERT_TRUE(flight.run_until(
        [&] { return flight.autopilot.armed() && flight.autopilot.model().truth().motion.p.z() > height; }));
    flight.bridge_runs = false;
    flight.run(0.1);
    flight.bridge_runs = true;
    flight.bridge = Bridge(flight.config, FlightInMemory::uav(), flight.now);
    flight.bridge.flight_is_under_way();
    double before = 0.0;
    flight.each = [&] {
      const double z = flight.autopilot.model().truth().motion.p.z();
      ASSERT_GT(z, std::min(before, kTarget) - 0.05) << "it climbs on; from " << height;
      before = std::max(before, z);
    };
    ASSERT_TRUE(flight.run_until([&] { return flight.following(); }, 20.0)) << flight.bridge.status(flight.now).why_not;
    EXPECT_LT((flight.autopilot.model().truth().motion.p - Vec3(0, 0, 2)).norm(), 0.35) << height;
  }
}

TEST(ArduPilotManners, AJumpOfItsEstimateCountsAsAReset) {
  FlightInMemory flight(kArms, copter());
  ASSERT_TRUE(flight.run_until([&] { return flight.following(); }));
  flight.path = along;
  flight.run(3.0);
  EXPECT_EQ(flight.bridge.status(flight.now).resets, 0);
  flight.shifts = Vec3(0.4, 0.0, 0.0);
  flight.run(0.5);
  EXPECT_EQ(flight.bridge.status(flight.now).resets, 1);
}

TEST(ArduPilotManners, ATakeOffOfSomebodyToAnotherHeightIsWaitedFor) {
  FlightInMemory flight({.start = Start::Pilot, .set_parameters = true}, copter());
  flight.run(6.0);
  flight.bridge_runs = false;
  flight.ground_station(switch_to(4));
  flight.ground_station({.param = {1}, .command = kArmDisarm});
  flight.ground_station({.param = {0, 0, 0, 0, 0, 0, 5}, .command = kNavTakeoff});
  ASSERT_TRUE(flight.run_until([&] { return flight.autopilot.model().truth().motion.p.z() > 0.5; }));
  flight.bridge_runs = true;
  ASSERT_TRUE(flight.run_until([&] { return flight.following(); }, 20.0)) << flight.bridge.status(flight.now).why_not;
  EXPECT_NEAR(flight.autopilot.model().truth().motion.p.z(), 5.0, 0.35);
}

TEST(ArduPilotManners, ASetpointEndsTheTakeOffAndLiftsNothing) {
  SimulatedAutopilot autopilot(copter(), 1, UTime{0});
  UTime now{3'000'000};
  const auto command = [&](CommandLong c) {
    c.target_system = 1;
    autopilot.receive(to_frame(c, {255, 190}, 0), now);
  };
  const auto run = [&](double seconds) {
    for (const UTime end = now + Duration::from_seconds(seconds); now < end; now = now + Duration{2'000}) {
      autopilot.step(now);
    }
  };
  command(switch_to(4));
  command({.param = {1}, .command = kArmDisarm});
  ASSERT_TRUE(autopilot.armed());
  command({.param = {0, 0, 0, 0, 0, 0, 2}, .command = kNavTakeoff});
  autopilot.receive(
      to_frame(
          SetPositionTargetLocalNed{.p = {0, 0, -2}, .type_mask = 0x0800, .target_system = 1, .coordinate_frame = 1},
          {1, 191}, 0),
      now);
  run(9.0);
  EXPECT_TRUE(autopilot.model().truth().on_ground);
  run(2.0);
  EXPECT_FALSE(autopilot.armed()) << "it has stood for 10 s";
}

}  // namespace
}  // namespace tern::mavlink
