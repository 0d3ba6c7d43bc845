#include "mavlink/bridge.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mavlink/axes.h"
#include "tests/mavlink/flight_in_memory.h"

namespace tern::mavlink {
namespace {

using testing::Contains;
using testing::HasSubstr;

CommandLong switch_to(float main, float sub = 0) { return {.param = {1, main, sub}, .command = kDoSetMode}; }

/// Back and forth in y about (x, 0, 2), at most 5 m/s, with a smooth beginning and end.
MotionSample slalom(double t) {
  constexpr double kSpeed = 4.0, kSideways = 5.0, kH = 1e-3;
  const auto place = [](double s) {
    const double u = std::clamp(s / 4.0, 0.0, 1.0), smooth = u * u * u * (10 - 15 * u + 6 * u * u);
    const double omega = kSideways / (0.75 * kSpeed);
    const double x = s < 0 ? 0 : s < 4.0 ? kSpeed * 4.0 * u * u * u * (1.0 - 0.5 * u) : kSpeed * (s - 2.0);
    return Vec3(x, kSideways / (omega * omega) * smooth * std::sin(omega * s), 2.0);
  };
  const Vec3 a = place(t - 2 * kH), b = place(t - kH), c = place(t), d = place(t + kH), e = place(t + 2 * kH);
  MotionSample m;
  m.p = c;
  m.v = (d - b) / (2 * kH);
  m.a = (b - 2 * c + d) / (kH * kH);
  m.j = (e - 2 * d + 2 * b - a) / (2 * kH * kH * kH);
  return m;
}

/// RMSE of the true path while it follows.
double tracking(FlightInMemory& flight, double seconds) {
  flight.path = slalom;
  double squares = 0.0;
  int n = 0;
  flight.each = [&] {
    if (!flight.follows_since) return;
    const double t = (flight.now - *flight.follows_since).seconds();
    squares += (flight.autopilot.model().truth().motion.p - slalom(t).p).squaredNorm();
    ++n;
  };
  flight.run(seconds);
  flight.each = nullptr;
  return std::sqrt(squares / std::max(n, 1));
}

TEST(Bridge, TakesOffFollowsAndLands) {
  FlightInMemory flight;
  EXPECT_EQ(flight.bridge.status(flight.now).why_not, "no HEARTBEAT of an autopilot was received");
  ASSERT_TRUE(flight.run_until([&] { return flight.following(); })) << flight.bridge.status(flight.now).why_not;
  EXPECT_LT((flight.autopilot.model().truth().motion.p - Vec3(0, 0, 2)).norm(), 0.5);
  flight.bridge.land("the flight has ended");
  EXPECT_FALSE(flight.following());
  ASSERT_TRUE(flight.run_until([&] { return flight.bridge.stage() == Stage::Landed; }));
  EXPECT_TRUE(flight.autopilot.model().truth().on_ground);
  EXPECT_FALSE(flight.autopilot.armed());
}

TEST(Bridge, TracksASlalomThroughTheAutopilot) {
  FlightInMemory flight;
  ASSERT_TRUE(flight.run_until([&] { return flight.following(); }));
  EXPECT_LT(tracking(flight, 20.0), 0.15);
}

TEST(Bridge, AccelerationFeedForwardDecides) {
  FlightInMemory flight({.start = Start::Arm, .acceleration_gain = 0.0, .set_parameters = true});
  ASSERT_TRUE(flight.run_until([&] { return flight.following(); }));
  EXPECT_GT(tracking(flight, 20.0), 0.3);
}

TEST(Bridge, MapsTimesThoughTheAutopilotsClockRunsSlow) {
  FlightInMemory flight;
  ASSERT_TRUE(flight.run_until([&] { return flight.following(); }));
  double worst = 0.0;
  flight.each = [&] {
    const auto state = flight.bridge.state();
    // The estimate is at most 12 ms old: ODOMETRY at 100 Hz, plus one step and the delay.
    worst = std::max(worst, (flight.now - state->at).seconds());
    ASSERT_LE(state->at, flight.now);
  };
  flight.run(30.0);
  EXPECT_LT(worst, 0.02);
  EXPECT_NEAR(flight.bridge.autopilot().clock().rate(), 0.99, 1e-3);
}

TEST(Bridge, RefusesParametersThatFlyAwayWhenTheLinkIsLost) {
  FlightInMemory flight({.start = Start::Arm});
  flight.run(10.0);
  EXPECT_EQ(flight.bridge.stage(), Stage::Waiting);
  EXPECT_THAT(flight.bridge.status(flight.now).why_not, HasSubstr("COM_OBL_RC_ACT is 0, not within [4, 5]"));
  EXPECT_FALSE(flight.autopilot.armed());
  const auto set = [&](const char* name, std::int32_t value) {
    flight.autopilot.receive(to_frame(ParamSet{.param_value = std::bit_cast<float>(value),
                                               .target_system = 1,
                                               .param_id = text_of<16>(name),
                                               .param_type = 6},
                                      {255, 190}, 0),
                             flight.now);
  };
  set("COM_OBL_RC_ACT", 4);
  flight.run(2.0);
  EXPECT_THAT(flight.bridge.status(flight.now).why_not, HasSubstr("MPC_ACC_DECOUPLE is 1, not within [0, 0]"));
  set("MPC_ACC_DECOUPLE", 0);
  EXPECT_TRUE(flight.run_until([&] { return flight.following(); }));
}

TEST(Bridge, FliesWithThemWhenToldTo) {
  FlightInMemory flight({.start = Start::Arm, .check_parameters = false});
  EXPECT_TRUE(flight.run_until([&] { return flight.following(); }));
}

TEST(Bridge, SaysWhyItIsNotArmed) {
  FlightInMemory flight({.start = Start::Arm, .set_parameters = true, .without_remote = true});
  flight.set_parameter("SIM_ARM_REFUSE", 1.0F);
  flight.run(12.0);
  EXPECT_FALSE(flight.autopilot.armed());
  EXPECT_EQ(flight.bridge.stage(), Stage::Engaging);
  EXPECT_THAT(flight.bridge.status(flight.now).why_not, HasSubstr("arming temporarily rejected: Arming denied"));
  flight.run(120.0);
  EXPECT_EQ(flight.bridge.stage(), Stage::StoodBack);
  flight.set_parameter("SIM_ARM_REFUSE", 0.0F);
  flight.run(5.0);
  EXPECT_FALSE(flight.autopilot.armed()) << "it was not told again";
  flight.bridge.order_flight();
  EXPECT_TRUE(flight.run_until([&] { return flight.following(); }));
}

TEST(Bridge, StandsBackWhenAPilotTakesOverUntilItIsToldAgain) {
  FlightInMemory flight;
  ASSERT_TRUE(flight.run_until([&] { return flight.following(); }));
  flight.ground_station(switch_to(3));
  ASSERT_TRUE(flight.run_until([&] { return !flight.following(); }));
  EXPECT_EQ(flight.bridge.stage(), Stage::StoodBack);
  EXPECT_THAT(flight.bridge.status(flight.now).why_not, HasSubstr("has changed to POSCTL: another pilot flies"));
  flight.run(20.0);
  EXPECT_EQ(flight.autopilot.mode(), "POSCTL");
  EXPECT_TRUE(flight.autopilot.armed());
  flight.bridge.land("the flight has ended");
  flight.run(3.0);
  EXPECT_EQ(flight.autopilot.mode(), "POSCTL") << "what another pilot flies is not landed";
  flight.bridge.order_flight();
  EXPECT_TRUE(flight.run_until([&] { return flight.following(); }));
  EXPECT_EQ(flight.autopilot.mode(), "OFFBOARD");
}

TEST(Bridge, WithStartPilotFollowsThePilotsSwitchAlone) {
  FlightInMemory flight({.start = Start::Pilot, .set_parameters = true});
  flight.run(8.0);
  flight.bridge.order_flight();
  flight.run(8.0);
  EXPECT_EQ(flight.bridge.stage(), Stage::Ready);
  EXPECT_FALSE(flight.autopilot.armed());
  flight.ground_station(switch_to(6));
  flight.ground_station({.param = {1}, .command = kArmDisarm});
  EXPECT_TRUE(flight.run_until([&] { return flight.following(); })) << flight.bridge.status(flight.now).why_not;
  flight.ground_station(switch_to(3));
  EXPECT_TRUE(flight.run_until([&] { return flight.bridge.stage() == Stage::StoodBack; }));
  flight.run(3.0);
  flight.ground_station(switch_to(6));
  EXPECT_TRUE(flight.run_until([&] { return flight.following(); }));
  flight.ground_station(switch_to(3));
  EXPECT_TRUE(flight.run_until([&] { return flight.bridge.stage() == Stage::StoodBack; }));
  flight.bridge.order_flight();
  EXPECT_TRUE(flight.run_until([&] { return flight.following(); })) << "the pilot has handed the vehicle over before";
}

TEST(Bridge, AShortCutOfTheLinkIsOutlived) {
  FlightInMemory flight;
  ASSERT_TRUE(flight.run_until([&] { return flight.following(); }));
  flight.cut = true;
  flight.run(0.2);
  flight.cut = false;
  flight.run(1.0);
  EXPECT_TRUE(flight.following());
}

TEST(Bridge, ALongCutLeavesTheAutopilotToItsFailsafe) {
  for (const double seconds : {1.0, 5.0}) {
    FlightInMemory flight;
    ASSERT_TRUE(flight.run_until([&] { return flight.following(); }));
    flight.cut = true;
    flight.run(0.5);
    EXPECT_THAT(flight.bridge.status(flight.now).why_not, HasSubstr("no message from the autopilot"));
    flight.run(seconds - 0.5);
    flight.cut = false;
    flight.each = [&] { ASSERT_TRUE(flight.autopilot.mode() == "AUTO.LAND" || !flight.autopilot.armed()) << seconds; };
    flight.run(2.0);
    EXPECT_EQ(flight.bridge.stage(), Stage::StoodBack);
    ASSERT_TRUE(flight.run_until([&] { return !flight.autopilot.armed(); }));
  }
}

TEST(Bridge, LandsWithALowBattery) {
  FlightInMemory flight;
  ASSERT_TRUE(flight.run_until([&] { return flight.following(); }));
  flight.set_parameter("SIM_BAT_PCT", 10.0F);
  EXPECT_TRUE(flight.run_until([&] { return flight.bridge.stage() == Stage::Landed; }));
  EXPECT_THAT(flight.words, Contains(HasSubstr("battery 10 %")));
}

TEST(Bridge, LandsWhereItIsAndSendsNoSetpointElsewhere) {
  FlightInMemory flight;
  ASSERT_TRUE(flight.run_until([&] { return flight.following(); }));
  flight.path = along;
  flight.run(5.0);
  flight.sent = [&](const Frame& frame) {
    const auto target = from_frame<SetPositionTargetLocalNed>(frame);
    if (!target) return;
    ASSERT_LT((enu_of(target->p) - flight.autopilot.model().truth().motion.p).norm(), 1.0);
  };
  flight.set_parameter("SIM_BAT_PCT", 10.0F);
  EXPECT_TRUE(flight.run_until([&] { return flight.bridge.stage() == Stage::Landed; }));
}

TEST(Bridge, HandsBackToTheAutopilotsLandingBeyondTheLastBound) {
  for (const bool leads : {true, false}) {
    UavSpec boxed = FlightInMemory::uav();
    boxed.flight_box = {Vec3(-5, -5, 0), Vec3(5, 5, 5)};
    FlightInMemory flight;
    flight.bridge = Bridge(flight.config, boxed, flight.now);
    ASSERT_TRUE(flight.run_until([&] { return flight.following(); }));
    double farthest = 0.0;
    flight.sent = [&](const Frame& frame) {
      const auto target = from_frame<SetPositionTargetLocalNed>(frame);
      if (target) farthest = std::max(farthest, enu_of(target->p).x());
    };
    if (leads) flight.path = along;
    if (!leads) flight.shifts.x() = 20.0;
    ASSERT_TRUE(flight.run_until([&] { return flight.bridge.stage() == Stage::Landed; })) << leads;
    EXPECT_THAT(flight.words, Contains(HasSubstr("more than 4 m outside uav.flight_box")));
    if (!leads) continue;
    EXPECT_LT(farthest, 5.0 + Bridge::kLastBound + 1.0) << "and the way to stop";
  }
}

TEST(Bridge, SaysForHowLongItHasNotFollowedAndWhatItDoesNotLand) {
  FlightInMemory flight;
  ASSERT_TRUE(flight.run_until([&] { return flight.following(); }));
  flight.ground_station(switch_to(3));
  flight.run(5.3);
  EXPECT_EQ(flight.bridge.status(flight.now).why_not,
            "stood back: the autopilot has changed to POSCTL: another pilot flies (for 5 s)");
  flight.bridge.land("the flight has ended");
  flight.run(0.1);
  EXPECT_THAT(flight.words,
              Contains(HasSubstr("the flight has ended: not landed, since the autopilot has changed to")));
}

TEST(Bridge, DoesNotTakeOffWithALowBattery) {
  FlightInMemory flight;
  flight.set_parameter("SIM_BAT_PCT", 20.0F);
  flight.run(10.0);
  EXPECT_THAT(flight.bridge.status(flight.now).why_not, HasSubstr("battery 20 %"));
  EXPECT_FALSE(flight.autopilot.armed());
}

TEST(Bridge, CountsTheEstimatorsJumps) {
  FlightInMemory flight;
  ASSERT_TRUE(flight.run_until([&] { return flight.following(); }));
  EXPECT_EQ(flight.bridge.status(flight.now).resets, 0);
  flight.set_parameter("SIM_EST_JUMP", 0.6F);
  flight.run(1.0);
  EXPECT_EQ(flight.bridge.status(flight.now).resets, 1);
  EXPECT_TRUE(flight.following());
}

TEST(Bridge, HoldsWhenSetpointsCeaseAndGoesOnWithThem) {
  FlightInMemory flight;
  ASSERT_TRUE(flight.run_until([&] { return flight.following(); }));
  tracking(flight, 6.0);
  flight.speaks = false;
  flight.run(4.0);
  EXPECT_LT(flight.autopilot.model().truth().motion.v.norm(), 0.3);
  EXPECT_EQ(flight.autopilot.mode(), "OFFBOARD");
}

TEST(Bridge, DoesNotFlyToASetpointThatIsFarAway) {
  FlightInMemory flight;
  ASSERT_TRUE(flight.run_until([&] { return flight.following(); }));
  const Vec3 before = flight.autopilot.model().truth().motion.p;
  flight.path = [](double) { return MotionSample{Vec3(30, 0, 2), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()}; };
  double farthest = 0.0;
  flight.each = [&] { farthest = std::max(farthest, (flight.autopilot.model().truth().motion.p - before).norm()); };
  flight.run(3.0);
  EXPECT_LT(farthest, 0.5);
}

TEST(Bridge, FliesOverALinkThatLosesDoublesAndReorders) {
  FlightInMemory flight;
  flight.faults = {.lost = 0.2, .doubled = 0.1, .delay_from = Duration{1'000}, .delay_to = Duration{30'000}};
  ASSERT_TRUE(flight.run_until([&] { return flight.following(); }));
  EXPECT_LT(tracking(flight, 15.0), 0.35);
  EXPECT_TRUE(flight.following());
  flight.bridge.land("end");
  EXPECT_TRUE(flight.run_until([&] { return flight.bridge.stage() == Stage::Landed; }));
}

TEST(Bridge, ABridgeStartedAnewInFlightLeavesTheVehicleToTheFailsafeThatCameFirst) {
  FlightInMemory flight;
  ASSERT_TRUE(flight.run_until([&] { return flight.following(); }));
  flight.bridge_runs = false;
  flight.run(1.1);
  flight.bridge_runs = true;
  flight.bridge = Bridge({.start = Start::Pilot, .set_parameters = true}, FlightInMemory::uav(), flight.now);
  flight.each = [&] {
    ASSERT_FALSE(flight.bridge.flies());
    ASSERT_TRUE(flight.autopilot.mode() == "AUTO.LAND" || !flight.autopilot.armed());
  };
  flight.run(5.0);
  EXPECT_FALSE(flight.autopilot.armed());
}

TEST(Bridge, StartedAnewItLeavesAVehicleInSomebodysHands) {
  FlightInMemory flight;
  ASSERT_TRUE(flight.run_until([&] { return flight.following(); }));
  flight.ground_station(switch_to(3));
  flight.bridge = Bridge(flight.config, FlightInMemory::uav(), flight.now);
  flight.run(10.0);
  EXPECT_EQ(flight.bridge.stage(), Stage::StoodBack);
  EXPECT_EQ(flight.autopilot.mode(), "POSCTL");
}

TEST(Bridge, DoesNotArmForAFlightThatIsUnderWay) {
  FlightInMemory flight;
  flight.bridge.flight_is_under_way();
  flight.run(8.0);
  EXPECT_EQ(flight.bridge.stage(), Stage::Ready);
  EXPECT_FALSE(flight.autopilot.armed());
  flight.bridge.order_flight();
  EXPECT_TRUE(flight.run_until([&] { return flight.following(); }));
}

TEST(Bridge, StrangersChangeNothing) {
  FlightInMemory flight;
  ASSERT_TRUE(flight.run_until([&] { return flight.following(); }));
  for (const Address stranger : {Address{2, 1}, Address{1, 2}, Address{255, 190}}) {
    flight.bridge.receive(to_frame(Heartbeat{.custom_mode = 3U << 16U, .autopilot = 12}, stranger, 0), flight.now);
    flight.bridge.receive(to_frame(SysStatus{.battery_remaining = 1}, stranger, 0), flight.now);
    flight.bridge.receive(to_frame(LocalPositionNed{.time_boot_ms = 1, .p = {90, 90, 90}}, stranger, 0), flight.now);
  }
  flight.run(1.0);
  EXPECT_TRUE(flight.following());
  EXPECT_EQ(flight.bridge.autopilot().strangers(), 9);
}

TEST(Bridge, ShiftsTheTruthToWhereTheVehicleStandsBeforeItIsArmed) {
  SimulatedAutopilotConfig drifting;
  drifting.estimator.drift_m = 0.5;
  FlightInMemory flight({.start = Start::Arm, .set_parameters = true}, drifting, 3);
  ASSERT_TRUE(flight.run_until([&] { return flight.bridge.stage() == Stage::Engaging; }));
  ASSERT_TRUE(flight.bridge.truth());
  EXPECT_GT((flight.bridge.state()->motion.p - flight.autopilot.model().truth().motion.p).norm(), 0.1);
  EXPECT_LT((flight.bridge.truth()->motion.p - flight.bridge.state()->motion.p).norm(), 0.05);
  ASSERT_TRUE(flight.run_until([&] { return flight.following(); }));
  const Vec3 shift = flight.bridge.truth()->motion.p - flight.autopilot.model().truth().motion.p;
  flight.run(5.0);
  const Vec3 later = flight.bridge.truth()->motion.p - flight.autopilot.model().truth().motion.p;
  EXPECT_LT((later - shift).norm(), 0.05) << "what drifts in flight is an error";
}

TEST(Bridge, TellsExternalVisionInTheAutopilotsFrameAndOnlyWhenAsked) {
  for (const bool asked : {true, false}) {
    UavSpec uav;
    uav.start = Vec3(10, 20, 2);
    UTime now{1'000'000'000};
    Bridge bridge({.external_vision = asked}, uav, now);
    bridge.receive(to_frame(Heartbeat{.autopilot = 12}, {1, 1}, 0), now);
    UavState seen;
    seen.at = now;
    seen.motion.p = Vec3(11, 22, 3);
    seen.motion.v = Vec3(0.5, 0, 0);
    bridge.receive_vision(seen);
    bridge.receive_vision(seen);
    std::vector<Odometry> told;
    for (const Frame& frame : bridge.take_frames()) {
      if (const auto m = from_frame<Odometry>(frame)) told.push_back(*m);
    }
    ASSERT_EQ(told.size(), asked ? 1U : 0U) << "no state twice";
    if (!asked) continue;
    EXPECT_EQ(told[0].p, (std::array<float, 3>{2, 1, -3}));
    EXPECT_EQ(told[0].v, (std::array<float, 3>{0, 0.5F, 0}));
    EXPECT_NEAR(yaw_of(swapped(quaternion_of(told[0].q))), 0.0, 1e-6);
    EXPECT_EQ(told[0].time_usec, 1'000'000'000U);
  }
}

TEST(Autopilot, TakesTheTruthThatStatesNoTimeForWhenItCameButNoneWithoutAnOrigin) {
  const HilStateQuaternion hil{.q = {1, 0, 0, 0}, .lat = 473977418, .lon = 85455938, .alt = 488'500};
  UTime now{1'000'000'000};
  Autopilot autopilot;
  const auto receive = [&](const auto& message) { autopilot.receive(to_frame(message, {1, 1}, 0), now); };
  receive(Heartbeat{.autopilot = 12});
  receive(hil);
  EXPECT_FALSE(autopilot.truth()) << "above where, is not known yet";
  receive(GpsGlobalOrigin{.latitude = 473977418, .longitude = 85455938, .altitude = 488'000});
  receive(hil);
  ASSERT_TRUE(autopilot.truth());
  EXPECT_EQ(autopilot.truth()->at, now);
  EXPECT_LT((autopilot.truth()->motion.p - Vec3(0.0, 0.0, 0.5)).norm(), 1e-6);
  now = now + Duration{10'000};
  receive(HilStateQuaternion{.q = {1, 0, 0, 0}});
  EXPECT_LT(autopilot.truth()->at, now) << "a simulation that does not know yet where it is";
}

/// As PX4's Gazebo sends it: attitude and velocity at 100 Hz, a new position in every third message.
TEST(Autopilot, TakesNoTruthWhosePositionIsThatOfBefore) {
  UTime now{1'000'000'000};
  Autopilot autopilot;
  const auto receive = [&](const auto& message) { autopilot.receive(to_frame(message, {1, 1}, 0), now); };
  receive(Heartbeat{.autopilot = 12});
  receive(GpsGlobalOrigin{.latitude = 473977418, .longitude = 85455938, .altitude = 488'000});
  int taken = 0;
  for (int k = 0; k < 30; ++k, now = now + Duration{10'000}) {
    const std::int32_t mm = 60 * (k - k % 3);  // upwards at 6 m/s
    receive(HilStateQuaternion{
        .q = {1, 0, 0, 0}, .lat = 473977418, .lon = 85455938, .alt = 488'500 + mm, .v = {0, 0, -600}});
    ASSERT_TRUE(autopilot.truth());
    const UavState& truth = *autopilot.truth();
    const double late_s = (now - truth.at).seconds();
    EXPECT_NEAR(truth.motion.p.z() + 6.0 * late_s, 0.5 + 0.06 * k, 1e-6);
    taken += truth.at == now ? 1 : 0;
  }
  EXPECT_EQ(taken, 10);
  const HilStateQuaternion rests{.q = {1, 0, 0, 0}, .lat = 473977418, .lon = 85455938, .alt = 490'120};
  for (int k = 0; k < 3; ++k, now = now + Duration{10'000}) receive(rests);
  EXPECT_EQ(autopilot.truth()->at, now - Duration{10'000}) << "who rests is where it was";
}

TEST(Bridge, AnswersToOthersAreNoneOfItsOwn) {
  FlightInMemory flight;
  flight.set_parameter("SIM_ARM_REFUSE", 1.0F);
  ASSERT_TRUE(flight.run_until([&] { return flight.bridge.stage() == Stage::Engaging; }));
  const auto say = [&](std::uint8_t result, std::uint8_t component) {
    flight.bridge.receive(
        to_frame(CommandAck{.command = 400, .result = result, .target_component = component}, {1, 1}, 0), flight.now);
  };
  say(2, 190);
  say(5, 0);
  EXPECT_EQ(flight.bridge.status(flight.now).why_not, "engaging");
  say(2, 191);
  EXPECT_THAT(flight.bridge.status(flight.now).why_not, HasSubstr("arming denied"));
}

TEST(RequiredParameters, AskForNoNarrowerBoundsThanPlansHave) {
  UavSpec uav;
  uav.limits.v_max = Vec3(3, 4, 2);
  uav.limits.dynamics = Dynamics{.tilt_max_deg = 60.0, .body_rate_max_deg_s = 500.0};
  std::map<std::string, double> values{{"COM_OBL_RC_ACT", 4},     {"COM_OF_LOSS_T", 0.5},    {"MPC_XY_VEL_MAX", 5},
                                       {"MPC_Z_VEL_MAX_UP", 3},   {"MPC_Z_VEL_MAX_DN", 1.5}, {"MPC_TILTMAX_AIR", 45},
                                       {"MC_ROLLRATE_MAX", 1000}, {"MC_PITCHRATE_MAX", 220}, {"MC_AIRMODE", 0}};
  const auto faults = [&](bool without_remote, bool vision) {
    return parameter_faults(required_parameters(Firmware::Px4, uav, 1, without_remote, vision), values, true);
  };
  const auto all = faults(false, false);
  EXPECT_THAT(all, HasSubstr("uav.limits.v_max (z) is 2, but MPC_Z_VEL_MAX_DN is 1.5: 1.5 would fit"));
  EXPECT_THAT(all, HasSubstr("uav.dynamics.tilt_max is 60, but MPC_TILTMAX_AIR is 45: 36 would fit"));
  EXPECT_THAT(all, HasSubstr("uav.dynamics.body_rate_max is 500, but MC_PITCHRATE_MAX is 220: 176 would fit"));
  EXPECT_THAT(all, Not(HasSubstr("thrust")));
  values["MPC_THR_HOVER"] = 0.625;
  EXPECT_THAT(faults(false, false),
              HasSubstr("uav.dynamics.thrust_max is 19.6, but MPC_THR_HOVER is 0.625 (allows 15.69): 12.6 would fit"));
  values["MPC_THR_HOVER"] = 0.5F;
  values["MPC_Z_VEL_MAX_DN"] = 2, values["MPC_TILTMAX_AIR"] = 60, values["MC_PITCHRATE_MAX"] = 500;
  EXPECT_EQ(faults(false, false), "");
  EXPECT_THAT(faults(true, false), HasSubstr("COM_RC_IN_MODE was not read"));
  EXPECT_THAT(faults(false, true), HasSubstr("EKF2_EV_CTRL was not read"));
  for (const RequiredParameter& r : required_parameters(Firmware::Px4, uav, 1, true, true)) {
    values[r.name] = r.recommended;
  }
  EXPECT_EQ(faults(true, true), "") << "what is recommended is allowed";
  values.erase("MPC_ACC_DECOUPLE");
  EXPECT_EQ(faults(true, true), "") << "an older PX4 has none";
  const auto required = required_parameters(Firmware::Px4, uav, 1, true, true);
  EXPECT_EQ(parameter_faults(required, values, false), "MPC_ACC_DECOUPLE was not read") << "it may still come";
  values["MPC_ACC_DECOUPLE"] = 1;
  EXPECT_THAT(faults(true, true), HasSubstr("MPC_ACC_DECOUPLE is 1, not within [0, 0]"));
  uav.limits.dynamics.reset();
  EXPECT_THAT(faults(false, false), HasSubstr("uav.dynamics.tilt_max (not stated) is 85, but MPC_TILTMAX_AIR is 60"));
}

TEST(RequiredParameters, OfACopterAreThoseThatShapeWhatItIsToldUnderTheNamesOfItsVersion) {
  UavSpec uav;
  uav.limits.dynamics = Dynamics{.thrust_max = 16.0, .tilt_max_deg = 38.0, .body_rate_max_deg_s = 170.0};
  const std::map<std::string, double> older{{"GUID_TIMEOUT", 0.5}, {"FS_GCS_ENABLE", 5},   {"SYSID_MYGCS", 255},
                                            {"ANGLE_MAX", 3000},   {"PSC_JERK_XY", 5},     {"PSC_JERK_Z", 5},
                                            {"WPNAV_ACCEL", 250},  {"WPNAV_ACCEL_Z", 100}, {"ATC_ACCEL_R_MAX", 110000}};
  const std::map<std::string, double> newer{{"GUID_TIMEOUT", 0.5}, {"FS_GCS_ENABLE", 5}, {"MAV_GCS_SYSID", 255},
                                            {"ATC_ANGLE_MAX", 30}, {"PSC_JERK_NE", 5},   {"PSC_JERK_D", 5},
                                            {"WP_ACC", 2.5},       {"WP_ACC_Z", 1},      {"ATC_ACC_R_MAX", 1100}};
  auto values = older;
  const auto faults = [&] {
    return parameter_faults(required_parameters(Firmware::ArduPilot, uav, 3, false, false, values), values, true);
  };
  EXPECT_THAT(faults(), HasSubstr("SYSID_MYGCS is 255, not within [3, 3]"));
  EXPECT_THAT(faults(), HasSubstr("uav.dynamics.tilt_max is 38, but ANGLE_MAX is 3000 (allows 30): 24 would fit"));
  EXPECT_THAT(faults(), HasSubstr("PSC_JERK_XY is 5, below 47.4"));  // 16 m/s2 that turn by 170 degrees/s
  EXPECT_THAT(faults(), HasSubstr("is 47.47, but WPNAV_ACCEL is 250 (allows 10.85): 9.76 would fit"));
  EXPECT_THAT(faults(), HasSubstr("uav.limits.j_max (z) is 47.47, but WPNAV_ACCEL_Z is 100 (allows 25.13)"));
  values = newer;
  EXPECT_THAT(faults(), HasSubstr("MAV_GCS_SYSID is 255, not within [3, 3]"));
  EXPECT_THAT(faults(), HasSubstr("uav.dynamics.tilt_max is 38, but ATC_ANGLE_MAX is 30: 24 would fit"));
  EXPECT_THAT(faults(), HasSubstr("PSC_JERK_NE is 5, below 47.4"));
  EXPECT_THAT(faults(), HasSubstr("PSC_JERK_D is 5, below 47.4"));
  EXPECT_THAT(faults(), HasSubstr("is 47.47, but WP_ACC is 2.5 (allows 10.85): 9.76 would fit"));
  values["ATC_ACC_R_MAX"] = 275.0;
  EXPECT_THAT(faults(), HasSubstr("WP_ACC is 2.5 (allows 5.42")) << "a large vehicle turns slowly";
  values["ATC_ACC_R_MAX"] = 0.0;
  EXPECT_THAT(faults(), Not(HasSubstr("WP_ACC is"))) << "0 is no limit";

  uav.limits.j_max = Vec3(3, 4, 2);
  for (const bool is_older : {true, false}) {
    values = is_older ? older : newer;
    values[is_older ? "ANGLE_MAX" : "ATC_ANGLE_MAX"] *= 38.0 / 30.0;
    values[is_older ? "SYSID_MYGCS" : "MAV_GCS_SYSID"] = 3;
    values["GUID_OPTIONS"] = 5;
    EXPECT_EQ(faults(), "");
    values["GUID_OPTIONS"] = 5 + 16;
    EXPECT_THAT(faults(), HasSubstr("GUID_OPTIONS is 21, with bits of 48: it would not correct position or velocity"));
    values.erase(is_older ? "SYSID_MYGCS" : "MAV_GCS_SYSID");
    EXPECT_THAT(faults(), HasSubstr("SYSID_MYGCS was not read")) << "under one of both names it is there";
  }
}

TEST(RequiredParameters, OfACopterFitWhenTheyAreWritten) {
  UavSpec uav;
  uav.limits.dynamics = Dynamics{.thrust_max = 16.0, .tilt_max_deg = 38.0, .body_rate_max_deg_s = 170.0};
  std::map<std::string, double> values;
  for (const RequiredParameter& r : required_parameters(Firmware::ArduPilot, uav, 3, false, false)) {
    values[r.name] = r.recommended;
  }
  EXPECT_EQ(parameter_faults(required_parameters(Firmware::ArduPilot, uav, 3, false, false, values), values, true), "");
  EXPECT_EQ(values.at("WPNAV_ACCEL"), 100.0 * values.at("WP_ACC")) << "cm/s2 in older versions";
}

TEST(Axes, TurnBothWaysAndAgree) {
  const Eigen::Quaterniond q = Eigen::Quaterniond(0.5, 0.1, -0.4, 0.7).normalized();
  EXPECT_LT((swapped(swapped(q)).coeffs().cwiseAbs() - q.coeffs().cwiseAbs()).norm(), 1e-12);
  const Vec3 body(1, 2, 3), frd(1, -2, -3);
  EXPECT_LT((swapped(q) * frd - swapped(Vec3(q * body))).norm(), 1e-12);
  EXPECT_NEAR(swapped_yaw(0.0), std::numbers::pi / 2.0, 1e-12);
  EXPECT_NEAR(swapped_yaw(std::numbers::pi / 2.0), 0.0, 1e-12);
}

}  // namespace
}  // namespace tern::mavlink
