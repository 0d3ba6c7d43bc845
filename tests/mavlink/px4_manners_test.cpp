// Behaviour of PX4 that is stricter than its documents, or more active; from its source (commander/failsafe,
// UserModeIntention, mavlink_parameters, mc_pos_control). The simulated autopilot has it, and the bridge copes with it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mavlink/bridge.h"
#include "tests/mavlink/flight_in_memory.h"

namespace tern::mavlink {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

CommandLong switch_to(float main) { return {.param = {1, main}, .command = kDoSetMode}; }

TEST(Px4Manners, OffboardIsTakenUpAgainByItselfWhenSetpointsCome) {
  FlightInMemory flight;
  ASSERT_TRUE(flight.run_until([&] { return flight.following(); }));
  flight.bridge_runs = false;
  flight.run(1.1);
  EXPECT_EQ(flight.autopilot.mode(), "AUTO.LAND");
  const SetPositionTargetLocalNed target{
      .p = {0, 0, -2}, .type_mask = 0x0800, .target_system = 1, .coordinate_frame = 1};
  flight.autopilot.receive(to_frame(target, {1, 191}, 0), flight.now);
  flight.run(0.1);
  EXPECT_EQ(flight.autopilot.mode(), "OFFBOARD");
}

TEST(Px4Manners, TheBridgeDoesNotWakeAVehicleFromItsFailsafe) {
  for (const double seconds : {1.1, 1.5, 2.5}) {
    FlightInMemory flight;
    ASSERT_TRUE(flight.run_until([&] { return flight.following(); }));
    flight.cut = true;
    flight.run(seconds);
    ASSERT_EQ(flight.autopilot.mode(), "AUTO.LAND");
    flight.cut = false;
    flight.each = [&] { ASSERT_TRUE(flight.autopilot.mode() == "AUTO.LAND" || !flight.autopilot.armed()); };
    ASSERT_TRUE(flight.run_until([&] { return flight.bridge.stage() == Stage::StoodBack; })) << seconds;
    EXPECT_THAT(flight.bridge.status(flight.now).why_not, HasSubstr("autopilot failsafe: it is in AUTO.LAND"));
    ASSERT_TRUE(flight.run_until([&] { return !flight.autopilot.armed(); })) << seconds;
    EXPECT_EQ(flight.bridge.stage(), Stage::StoodBack);
  }
}

TEST(Px4Manners, NorDoesOneThatLetsAPilotSwitchBeforeThePilotHasIt) {
  FlightInMemory flight({.start = Start::Pilot, .set_parameters = true});
  flight.run(5.0);
  flight.ground_station(switch_to(6));
  flight.ground_station({.param = {1}, .command = kArmDisarm});
  ASSERT_TRUE(flight.run_until([&] { return flight.following(); }));
  flight.cut = true;
  flight.run(1.1);
  flight.cut = false;
  flight.each = [&] { ASSERT_EQ(flight.autopilot.mode(), "AUTO.LAND"); };
  flight.run(0.5);
  flight.each = nullptr;
  ASSERT_TRUE(flight.autopilot.armed());
  flight.ground_station(switch_to(3));
  flight.run(2.0);
  flight.ground_station(switch_to(6));
  EXPECT_TRUE(flight.run_until([&] { return flight.following(); })) << "the stream for the pilot's switch runs again";
}

TEST(Px4Manners, ABridgeStartedAnewDoesNotWakeItEither) {
  FlightInMemory flight;
  ASSERT_TRUE(flight.run_until([&] { return flight.following(); }));
  flight.bridge_runs = false;
  flight.run(1.1);
  flight.bridge_runs = true;
  flight.bridge = Bridge(flight.config, FlightInMemory::uav(), flight.now);
  flight.each = [&] { ASSERT_TRUE(flight.autopilot.mode() == "AUTO.LAND" || !flight.autopilot.armed()); };
  ASSERT_TRUE(flight.run_until([&] { return !flight.autopilot.armed(); }));
}

TEST(Px4Manners, AfterASilenceTheModeIsAskedForAndFlightGoesOn) {
  FlightInMemory flight;
  ASSERT_TRUE(flight.run_until([&] { return flight.following(); }));
  flight.cut = true;
  flight.run(0.4);
  EXPECT_FALSE(flight.following());
  flight.cut = false;
  flight.run(0.15);
  EXPECT_TRUE(flight.following()) << "though HEARTBEAT comes by itself once a second only";
}

TEST(Px4Manners, APilotsSwitchIsSeenWithinAQuarterOfASecond) {
  FlightInMemory flight;
  ASSERT_TRUE(flight.run_until([&] { return flight.following(); }));
  for (int k = 0; k < 3; ++k) {
    flight.run(1.27);
    flight.ground_station(switch_to(3));
    flight.run(0.25);
    EXPECT_EQ(flight.bridge.stage(), Stage::StoodBack);
    flight.bridge.order_flight();
    ASSERT_TRUE(flight.run_until([&] { return flight.following(); }));
  }
}

TEST(Px4Manners, ArmingIsDeniedWithoutTheGroundStationThatIsAskedForAndTheReasonIsSaid) {
  FlightInMemory flight;
  flight.ground_station_there = false;
  flight.run(12.0);
  EXPECT_FALSE(flight.autopilot.armed());
  EXPECT_THAT(
      flight.bridge.status(flight.now).why_not,
      HasSubstr("arming temporarily rejected: a PX4 gives the reason to ground stations alone, and NAV_DLL_ACT, "
                "which is not 0"));
  FlightInMemory alone({.start = Start::Arm, .set_parameters = true, .without_remote = true});
  alone.ground_station_there = false;
  EXPECT_TRUE(alone.run_until([&] { return alone.following(); })) << alone.bridge.status(alone.now).why_not;
}

TEST(Px4Manners, TheReasonWhyArmingIsDeniedIsToldThoughNoGroundStationIsThere) {
  FlightInMemory flight({.start = Start::Arm, .set_parameters = true, .without_remote = true});
  flight.ground_station_there = false;
  flight.set_parameter("SIM_ARM_REFUSE", 1.0F);
  flight.run(12.0);
  EXPECT_FALSE(flight.autopilot.armed());
  EXPECT_THAT(flight.bridge.status(flight.now).why_not,
              AllOf(HasSubstr("Arming denied: Resolve system health failures first; "
                              "Preflight Fail: Accel 0 uncalibrated"),
                    Not(HasSubstr("?"))));
}

TEST(Px4Manners, TheBridgeIsAGroundStationOnlyIfTheLossOfOneHasNoEffect) {
  for (const Manners manners : {Manners::Px4, Manners::ArduPilot}) {
    for (const bool alone : {true, false}) {
      SimulatedAutopilotConfig autopilot;
      autopilot.manners = manners;
      FlightInMemory flight({.start = Start::Arm, .set_parameters = true, .without_remote = alone}, autopilot);
      int beats = 0;
      flight.sent = [&](const Frame& frame) {
        const auto heartbeat = from_frame<Heartbeat>(frame);
        if (!heartbeat || heartbeat->type != 6) return;
        ++beats;
        EXPECT_EQ(frame.from.component, kGroundStationComponent);
      };
      ASSERT_TRUE(flight.run_until([&] { return flight.following(); }));
      beats = 0;
      flight.run(5.0);
      EXPECT_EQ(beats, alone && manners == Manners::Px4 ? 10 : 0) << "in flight as well: it must not end";
    }
  }
}

TEST(Px4Manners, WithoutAPilotALandingThatNobodyAskedForIsItsFailsafe) {
  for (const bool alone : {true, false}) {
    FlightInMemory flight({.start = Start::Arm, .set_parameters = true, .without_remote = alone});
    ASSERT_TRUE(flight.run_until([&] { return flight.following(); }));
    flight.ground_station({.command = kNavLand});
    ASSERT_TRUE(flight.run_until([&] { return flight.bridge.stage() == Stage::StoodBack; }));
    EXPECT_THAT(flight.bridge.status(flight.now).why_not,
                HasSubstr(alone ? "autopilot failsafe: it is in AUTO.LAND" : "a pilot's command, or its failsafe"));
  }
}

TEST(Px4Manners, TheClimbWaitsForRotorsThatSpinUp) {
  FlightInMemory flight;
  double fastest = 0.0;
  flight.each = [&] { fastest = std::max(fastest, flight.autopilot.model().truth().motion.v.z()); };
  ASSERT_TRUE(flight.run_until([&] { return flight.following(); }));
  EXPECT_LT(fastest, 2.0) << "what it lagged behind on the ground is not caught up with speed; climb_speed is 1 m/s";
}

TEST(Px4Manners, AfterLandingItIsInOffboardAgainAndFliesWhenTold) {
  FlightInMemory flight;
  ASSERT_TRUE(flight.run_until([&] { return flight.following(); }));
  flight.bridge.land("the flight has ended");
  ASSERT_TRUE(flight.run_until([&] { return flight.bridge.stage() == Stage::Landed; }));
  EXPECT_EQ(flight.autopilot.mode(), "OFFBOARD");
  flight.run(5.0);
  EXPECT_FALSE(flight.autopilot.armed());
  flight.bridge.order_flight();
  EXPECT_TRUE(flight.run_until([&] { return flight.following(); })) << flight.bridge.status(flight.now).why_not;
}

/// Along x, from rest, 3 m/s at last.
MotionSample straight(double t) {
  constexpr double kSpeed = 3.0, kA = 1.5, kUntil = kSpeed / kA;
  MotionSample m{Vec3(0, 0, 2), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  m.p.x() = t < kUntil ? 0.5 * kA * t * t : kSpeed * (t - 0.5 * kUntil);
  m.v.x() = t < kUntil ? kA * t : kSpeed;
  m.a.x() = t < kUntil ? kA : 0.0;
  return m;
}

TEST(Px4Manners, SetpointsAreHeldOrCarriedOnAndTheVehicleIsNotLateForThat) {
  for (const auto& [manners, rate] :
       {std::pair(Manners::Px4, 20.0), std::pair(Manners::Px4, 50.0), std::pair(Manners::ArduPilot, 20.0)}) {
    SimulatedAutopilotConfig autopilot;
    autopilot.manners = manners;
    // Without a committed trajectory a command brakes 20 ms after the newest SETPOINT: with 20 setpoints a second,
    // those of half a period later are a little slow. Stiff gains make that little.
    autopilot.tuned = true;
    FlightInMemory flight({.start = Start::Arm, .rate_hz = rate, .set_parameters = true}, autopilot);
    ASSERT_TRUE(flight.run_until([&] { return flight.following(); }));
    flight.path = straight;
    flight.run(8.0);
    double behind = 0.0;
    int n = 0;
    flight.each = [&] {
      const MotionSample commanded = straight((flight.now - *flight.follows_since).seconds());
      behind += commanded.p.x() - flight.autopilot.model().truth().motion.p.x();
      ++n;
    };
    flight.run(4.0);
    EXPECT_NEAR(behind / n / 3.0, 0.0, 0.004) << "seconds behind at 3 m/s, " << rate << " setpoints a second";
  }
}

TEST(Px4Manners, DragThatNothingIsFedForwardAgainstIsSaid) {
  SimulatedAutopilotConfig sih;
  sih.quadrotor.body.drag_per_s = sih.quadrotor.body.drag_up_per_s = 1.0;
  sih.quadrotor.controller.position_p = 0.95;
  sih.quadrotor.controller.velocity_p = 1.8;
  sih.quadrotor.controller.velocity_i = 0.4;
  for (const double drag : {0.3, 1.0}) {
    FlightInMemory flight({.start = Start::Arm, .drag_per_s = drag, .set_parameters = true}, sih);
    ASSERT_TRUE(flight.run_until([&] { return flight.following(); }));
    flight.path = straight;
    flight.run(12.0);
    ASSERT_TRUE(flight.following());
    const auto said = Contains(HasSubstr("behind its setpoints: mavlink.drag_per_s is 0.3, too small"));
    if (drag < 1.0) {
      EXPECT_THAT(flight.words, said);
    } else {
      EXPECT_THAT(flight.words, Not(Contains(HasSubstr("mavlink.drag_per_s"))));
    }
  }
}

TEST(Px4Manners, ASimulationInSlowMotionIsNotFlown) {
  SimulatedAutopilotConfig slow;
  slow.clock_rate = 0.7;
  FlightInMemory flight({.start = Start::Arm, .set_parameters = true}, slow);
  flight.run(20.0);
  EXPECT_FALSE(flight.autopilot.armed());
  EXPECT_THAT(flight.bridge.status(flight.now).why_not, HasSubstr("clock runs at 0.70 of this clock"));
}

TEST(Px4Manners, ParametersAreSetByTheirOwnTypeAndCommandsNameWhomTheyMean) {
  SimulatedAutopilot autopilot({}, 1, UTime{0});
  const auto answers = [&](const auto& message) {
    autopilot.take_frames();
    autopilot.receive(to_frame(message, {255, 190}, 0), UTime{0});
    return autopilot.take_frames().size();
  };
  ParamSet set{.param_value = 4.0F, .target_system = 1, .param_id = text_of<16>("COM_OBL_RC_ACT"), .param_type = 9};
  EXPECT_EQ(answers(set), 0U) << "a float for an integer";
  set.param_value = std::bit_cast<float>(std::int32_t{4}), set.param_type = 6;
  EXPECT_EQ(answers(set), 1U);
  set.target_system = 0;
  EXPECT_EQ(answers(set), 0U);
  EXPECT_EQ(answers(ParamRequestRead{.target_system = 1, .param_id = text_of<16>("COM_OBL_ACT")}), 0U)
      << "of what it does not have it says nothing";
}

TEST(Px4Manners, WithoutGpsItFliesByWhatTheBridgeTellsItOfItsPlace) {
  FlightInMemory flight({.start = Start::Arm, .set_parameters = true, .external_vision = true});
  ASSERT_TRUE(flight.run_until([&] { return flight.following(); })) << flight.bridge.status(flight.now).why_not;
  ASSERT_TRUE(flight.bridge.truth());
  EXPECT_LT((flight.bridge.truth()->motion.p - flight.autopilot.model().truth().motion.p).norm(), 0.05);
  FlightInMemory blind({.start = Start::Arm, .set_parameters = true});
  blind.autopilot.receive(to_frame(ParamSet{.param_value = std::bit_cast<float>(std::int32_t{0}),
                                            .target_system = 1,
                                            .param_id = text_of<16>("EKF2_GPS_CTRL"),
                                            .param_type = 6},
                                   {255, 190}, 0),
                          blind.now);
  blind.run(10.0);
  EXPECT_FALSE(blind.autopilot.armed());
  EXPECT_THAT(blind.bridge.status(blind.now).why_not, HasSubstr("its estimator has no position"));
}

TEST(Px4Manners, AirmodeIsNotFlown) {
  FlightInMemory flight({.start = Start::Arm});
  flight.autopilot.receive(to_frame(ParamSet{.param_value = std::bit_cast<float>(std::int32_t{1}),
                                             .target_system = 1,
                                             .param_id = text_of<16>("MC_AIRMODE"),
                                             .param_type = 6},
                                    {255, 190}, 0),
                           flight.now);
  flight.run(10.0);
  EXPECT_FALSE(flight.autopilot.armed());
  EXPECT_THAT(flight.bridge.status(flight.now).why_not, HasSubstr("MC_AIRMODE is 1, not within [0, 0]"));
}

TEST(Px4Manners, RemoteLossMayBeExceptedInOtherModesToo) {
  const auto required = required_parameters(Firmware::Px4, FlightInMemory::uav(), 1, true, false);
  std::map<std::string, double> values;
  for (const RequiredParameter& r : required) values[r.name] = r.recommended;
  for (const double value : {4.0, 7.0, 12.0, 15.0, 31.0}) {
    values["COM_RCL_EXCEPT"] = value;
    EXPECT_EQ(parameter_faults(required, values, true), "") << value;
  }
  for (const double value : {0.0, 3.0, 8.0, 11.0}) {
    values["COM_RCL_EXCEPT"] = value;
    EXPECT_THAT(parameter_faults(required, values, true), HasSubstr("COM_RCL_EXCEPT is")) << value;
  }
}

}  // namespace
}  // namespace tern::mavlink
