// A vehicle has one who flies it: the bridge takes it from nobody, and leaves it to whoever takes it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mavlink/bridge.h"
#include "tests/mavlink/flight_in_memory.h"

namespace tern::mavlink {
namespace {

using testing::HasSubstr;

CommandLong switch_to(float main, float sub = 0) { return {.param = {1, main, sub}, .command = kDoSetMode}; }
const CommandLong kArm{.param = {1}, .command = kArmDisarm};

TEST(WhoFlies, WhileItEngagesAPilotWhoArmsInAnotherModeHasTheVehicle) {
  FlightInMemory flight;
  flight.set_parameter("SIM_ARM_REFUSE", 1.0F);
  ASSERT_TRUE(flight.run_until([&] { return flight.bridge.stage() == Stage::Engaging; }));
  flight.run(2.5);
  flight.set_parameter("SIM_ARM_REFUSE", 0.0F);
  flight.ground_station(switch_to(3));
  flight.ground_station(kArm);
  flight.each = [&] { ASSERT_EQ(flight.autopilot.mode(), "POSCTL"); };
  flight.run(5.0);
  EXPECT_EQ(flight.bridge.stage(), Stage::StoodBack);
  EXPECT_THAT(flight.bridge.status(flight.now).why_not, HasSubstr("armed in POSCTL: somebody else flies"));
}

TEST(WhoFlies, OnceToldAgainItTakesAVehicleOverButNotOneThatIsTakenAfterThat) {
  FlightInMemory flight;
  ASSERT_TRUE(flight.run_until([&] { return flight.following(); }));
  flight.ground_station(switch_to(3));
  ASSERT_TRUE(flight.run_until([&] { return flight.bridge.stage() == Stage::StoodBack; }));
  flight.bridge.told_to_fly();
  ASSERT_TRUE(flight.run_until([&] { return flight.bridge.stage() == Stage::Engaging; }));
  flight.ground_station(switch_to(4, 3));
  flight.each = [&] { ASSERT_EQ(flight.autopilot.mode(), "AUTO.LOITER"); };
  flight.run(5.0);
  EXPECT_EQ(flight.bridge.stage(), Stage::StoodBack);
}

TEST(WhoFlies, WhileItLandsAPilotWhoSwitchesHasTheVehicle) {
  FlightInMemory flight;
  ASSERT_TRUE(flight.run_until([&] { return flight.following(); }));
  flight.bridge.land("the flight has ended");
  flight.run(0.01);  // so that no HEARTBEAT has told of AUTO.LAND
  flight.ground_station(switch_to(3));
  flight.each = [&] { ASSERT_EQ(flight.autopilot.mode(), "POSCTL"); };
  flight.run(5.0);
  EXPECT_EQ(flight.bridge.stage(), Stage::StoodBack);
  EXPECT_THAT(flight.bridge.status(flight.now).why_not, HasSubstr("has left for POSCTL"));
  EXPECT_TRUE(flight.autopilot.armed());
}

TEST(WhoFlies, ItHasNotLandedWhileItsOwnCommandToArmIsOnItsWay) {
  FlightInMemory flight;
  bool asked = false;
  flight.sent = [&](const Frame& frame) {
    const auto command = from_frame<CommandLong>(frame);
    asked = asked || (command && command->command == kArmDisarm && command->param[0] == 1.0F);
  };
  ASSERT_TRUE(flight.run_until([&] { return flight.bridge.stage() == Stage::Engaging; }));
  flight.faults.delay_from = flight.faults.delay_to = Duration{300'000};
  while (!asked) flight.run(0.002);
  ASSERT_FALSE(flight.autopilot.armed());
  flight.bridge.land("asked to end");
  bool was_armed = false;
  flight.each = [&] {
    was_armed = was_armed || flight.autopilot.armed();
    ASSERT_FALSE(flight.bridge.stage() == Stage::Landed && flight.autopilot.armed());
  };
  ASSERT_TRUE(flight.run_until([&] { return flight.bridge.stage() == Stage::Landed; }));
  flight.bridge_runs = false;
  flight.run(3.0);
  EXPECT_TRUE(was_armed) << "the command was on its way";
  EXPECT_FALSE(flight.autopilot.armed());
  EXPECT_TRUE(flight.autopilot.model().truth().on_ground);
}

}  // namespace
}  // namespace tern::mavlink
