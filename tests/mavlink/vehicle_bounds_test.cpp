// Parameters that the bridge writes to an autopilot, and bounds of the vehicle that it does not raise.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mavlink/bridge.h"
#include "mavlink/required_parameters.h"
#include "tests/mavlink/flight_in_memory.h"

namespace tern::mavlink {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

/// Parameters of the simulated PX4 that set_parameters changes.
const std::map<std::string, float> kChanged{
    {"COM_OBL_RC_ACT", 0.0F}, {"COM_OF_LOSS_T", 1.0F}, {"MPC_ACC_DECOUPLE", 1.0F}, {"NAV_DLL_ACT", 2.0F}};
/// Bounds of the vehicle.
const std::map<std::string, float> kBounds{{"MPC_TILTMAX_AIR", 45.0F},   {"MC_ROLLRATE_MAX", 220.0F},
                                           {"MC_PITCHRATE_MAX", 220.0F}, {"MPC_XY_VEL_MAX", 12.0F},
                                           {"MPC_Z_VEL_MAX_UP", 3.0F},   {"MPC_Z_VEL_MAX_DN", 1.5F}};

const BridgeConfig kSets{.start = Start::Arm, .set_parameters = true, .without_remote = true};

/// A vehicle that tilts and turns farther than the simulated PX4 allows.
UavSpec racer() {
  UavSpec uav = FlightInMemory::uav();
  uav.limits.dynamics = Dynamics{.thrust_max = 18.0, .tilt_max_deg = 70.0, .body_rate_max_deg_s = 900.0};
  return uav;
}

void expect_values(FlightInMemory& flight, const std::map<std::string, float>& values) {
  for (const auto& [name, value] : values) EXPECT_EQ(flight.parameter(name), value) << name;
}

TEST(VehicleBounds, AreNotRaisedUnaskedAndTheRefusalNamesKeyParameterAndAValueThatFits) {
  FlightInMemory flight(kSets);
  flight.bridge = Bridge(kSets, racer(), flight.now);
  flight.run(10.0);
  EXPECT_FALSE(flight.autopilot.armed());
  EXPECT_THAT(flight.bridge.status(flight.now).why_not,
              AllOf(HasSubstr("uav.dynamics.tilt_max is 70, but MPC_TILTMAX_AIR is 45: 36 would fit"),
                    HasSubstr("uav.dynamics.body_rate_max is 900, but MC_ROLLRATE_MAX is 220: 176 would fit")));
  expect_values(flight, kBounds);
}

TEST(VehicleBounds, AreRaisedWhenAskedAndSetBackAfterTheFlight) {
  BridgeConfig raises = kSets;
  raises.raise_bounds = true;
  FlightInMemory flight(raises);
  flight.bridge = Bridge(raises, racer(), flight.now);
  ASSERT_TRUE(flight.run_until([&] { return flight.following(); })) << flight.bridge.status(flight.now).why_not;
  expect_values(flight, {{"MPC_TILTMAX_AIR", 70.0F}, {"MC_ROLLRATE_MAX", 900.0F}, {"COM_OBL_RC_ACT", 4.0F}});
  flight.bridge.land("the flight has ended");
  ASSERT_TRUE(flight.run_until([&] { return flight.bridge.stage() == Stage::Landed; }));
  ASSERT_TRUE(flight.run_until([&] { return !flight.bridge.has_set_parameters(); }, 3.0));
  expect_values(flight, kBounds);
  expect_values(flight, kChanged);
  EXPECT_THAT(flight.words, Contains("sets MPC_TILTMAX_AIR back to 45"));
}

TEST(VehicleBounds, ThrustIsThatOfTheHoverThrustAndCannotBeRaised) {
  SimulatedAutopilotConfig heavy;
  heavy.quadrotor.body.thrust_to_weight = 1.6;
  BridgeConfig raises = kSets;
  raises.raise_bounds = true;
  FlightInMemory flight(raises, heavy);
  flight.run(10.0);
  EXPECT_FALSE(flight.autopilot.armed());
  EXPECT_EQ(flight.bridge.status(flight.now).why_not,
            "uav.dynamics.thrust_max is 19.6, but MPC_THR_HOVER is 0.625 (allows 15.69): 12.6 would fit");
}

TEST(VehicleBounds, ADryRunListsWhatWouldBeWrittenAndWritesNothing) {
  BridgeConfig lists = kSets;
  lists.list_parameters = true;
  FlightInMemory flight(lists);
  flight.bridge = Bridge(lists, racer(), flight.now);
  flight.run(10.0);
  EXPECT_FALSE(flight.autopilot.armed());
  expect_values(flight, kChanged);
  expect_values(flight, kBounds);
  EXPECT_THAT(flight.words, Contains(AllOf(HasSubstr("would set COM_OBL_RC_ACT to 4 (it is 0)"),
                                           HasSubstr("would set MPC_ACC_DECOUPLE to 0 (it is 1)"),
                                           HasSubstr("uav.dynamics.tilt_max is 70, but MPC_TILTMAX_AIR is 45"))));
  EXPECT_THAT(flight.words, Not(Contains(HasSubstr("sets "))));
}

TEST(VehicleBounds, ADryRunNamesParametersThatWereNotRead) {
  const std::string changes = parameter_changes(required_parameters(Firmware::Px4, racer(), 1, true, false), {}, false);
  EXPECT_THAT(changes, AllOf(HasSubstr("COM_OBL_RC_ACT was not read"), HasSubstr("MPC_TILTMAX_AIR was not read")));
  EXPECT_THAT(changes, Not(HasSubstr("MC_ROLL_P"))) << "it may be absent";
}

TEST(VehicleBounds, ABridgeThatEndsBeforeItsWritesAreAnsweredSetsThemBackAsWell) {
  FlightInMemory flight(kSets);
  flight.set_parameter("SIM_ARM_REFUSE", 1.0F);
  flight.faults.delay_from = flight.faults.delay_to = Duration{200'000};
  bool written = false;
  flight.sent = [&](const Frame& frame) { written = written || from_frame<ParamSet>(frame).has_value(); };
  while (!written) flight.run(0.002);
  flight.bridge.end_parameters();
  ASSERT_TRUE(flight.run_until([&] { return !flight.bridge.has_set_parameters(); }, 3.0));
  flight.run(1.0);
  expect_values(flight, kChanged);
}

TEST(VehicleBounds, ABridgeThatEndsOnTheGroundSetsBackWhatItHasSet) {
  FlightInMemory flight(kSets);
  flight.set_parameter("SIM_ARM_REFUSE", 1.0F);
  flight.run(8.0);
  ASSERT_TRUE(flight.bridge.has_set_parameters());
  EXPECT_EQ(flight.parameter("COM_OBL_RC_ACT"), 4.0F);
  flight.bridge.end_parameters();
  ASSERT_TRUE(flight.run_until([&] { return !flight.bridge.has_set_parameters(); }, 3.0));
  expect_values(flight, kChanged);
}

TEST(VehicleBounds, ParametersAreNotSetBackInFlight) {
  FlightInMemory flight(kSets);
  ASSERT_TRUE(flight.run_until([&] { return flight.following(); }));
  flight.bridge.end_parameters();
  flight.run(3.0);
  EXPECT_TRUE(flight.bridge.has_set_parameters());
  EXPECT_EQ(flight.parameter("COM_OBL_RC_ACT"), 4.0F) << "the action after a loss must stay while it flies";
}

}  // namespace
}  // namespace tern::mavlink
