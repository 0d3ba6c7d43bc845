// One pilot per vehicle: the bridge takes it from no other pilot, and leaves it to one who takes it.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mavlink/bridge.h"
#include "tests/mavlink/flight_in_memory.h"
#include "tests/support/effort.h"

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
  EXPECT_THAT(flight.bridge.status(flight.now).why_not, HasSubstr("armed in POSCTL: another pilot flies"));
}

TEST(WhoFlies, OnceToldAgainItTakesAVehicleOverButNotOneThatIsTakenAfterThat) {
  FlightInMemory flight;
  ASSERT_TRUE(flight.run_until([&] { return flight.following(); }));
  flight.ground_station(switch_to(3));
  ASSERT_TRUE(flight.run_until([&] { return flight.bridge.stage() == Stage::StoodBack; }));
  flight.bridge.order_flight();
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
  flight.run(0.01);  // so that no HEARTBEAT has reported AUTO.LAND
  flight.ground_station(switch_to(3));
  flight.each = [&] { ASSERT_EQ(flight.autopilot.mode(), "POSCTL"); };
  flight.run(5.0);
  EXPECT_EQ(flight.bridge.stage(), Stage::StoodBack);
  EXPECT_THAT(flight.bridge.status(flight.now).why_not, HasSubstr("has changed to POSCTL"));
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

/// A flight in which the bridge commands a mode.
struct Race {
  SimulatedAutopilotConfig autopilot;
  Duration delay;
  std::function<void(FlightInMemory&)> story;
  std::uint16_t sought = kDoSetMode;
  CommandLong pilots = {};  ///< to a mode other than the present one
  std::string mode = {};

  [[nodiscard]] bool is_px4() const { return autopilot.manners == Manners::Px4; }

  [[nodiscard]] FlightInMemory flight() const {
    FlightInMemory flight({.start = Start::Arm, .set_parameters = true}, autopilot);
    flight.faults.delay_from = flight.faults.delay_to = delay;
    return flight;
  }

  /// The time at which the bridge commands the mode.
  [[nodiscard]] UTime commanded() const {
    FlightInMemory alone = flight();
    std::vector<UTime> times;
    alone.sent = [&](const Frame& frame) {
      const auto command = from_frame<CommandLong>(frame);
      if (command && command->command == sought) times.push_back(alone.now);
    };
    story(alone);
    return times.back();
  }

  /// The pilot switches at that time, and must have the vehicle in the end.
  void expect_the_pilot_has_it(UTime then) const {
    FlightInMemory flight = this->flight();
    bool switched = false;
    flight.each = [&] {
      if (!switched && flight.now >= then) flight.ground_station(pilots);
      switched = switched || flight.now >= then;
    };
    story(flight);
    flight.run(4.0);
    EXPECT_EQ(flight.autopilot.mode(), mode);
    EXPECT_EQ(flight.bridge.stage(), Stage::StoodBack);
  }
};

/// The switch may be any short time before or after the bridge's command.
void expect_nothing_is_overruled(const std::function<void(FlightInMemory&)>& story, std::uint16_t sought,
                                 Duration earliest, const std::string& ardupilots = "LOITER") {
  const Duration step{support::listed_at_effort(30'000, 10'000)};
  for (const Manners manners : {Manners::Px4, Manners::ArduPilot}) {
    for (const Duration delay : {Duration{1'000}, Duration{40'000}}) {
      Race race{{}, delay, story, sought};
      race.autopilot.manners = manners;
      race.pilots = race.is_px4() ? switch_to(4, 3) : switch_to(ardupilots == "LAND" ? 9 : 5);
      race.mode = race.is_px4() ? "AUTO.LOITER" : ardupilots;
      const UTime commanded = race.commanded();
      for (Duration offset = earliest; offset <= Duration{300'000}; offset = offset + step) {
        SCOPED_TRACE(fmt::format("{} after the command, delay {} us, PX4 {}", offset.us, delay.us, race.is_px4()));
        race.expect_the_pilot_has_it(commanded + offset);
      }
    }
  }
}

TEST(WhoFlies, ASwitchBesideItsCommandToLandIsNotOverruled) {
  const auto story = [](FlightInMemory& flight) {
    flight.run_until([&] { return flight.following(); });
    flight.run(1.0);
    flight.bridge.land("the flight has ended");
    flight.run(0.4);
  };
  expect_nothing_is_overruled(story, kNavLand, Duration{-300'000});
}

TEST(WhoFlies, ASwitchBesideItsCommandToTakeOverIsNotOverruled) {
  const auto story = [](FlightInMemory& flight) {
    flight.run_until([&] { return flight.following(); });
    flight.ground_station(flight.bridge.autopilot().firmware() == Firmware::Px4 ? switch_to(3) : switch_to(9));
    flight.run_until([&] { return flight.bridge.stage() == Stage::StoodBack; });
    flight.run(1.0);
    // A mode is commanded at a HEARTBEAT. Without one for 0.5 s, every switch of the pilot comes after the order.
    flight.hides = [](const Frame& frame) { return frame.id == Heartbeat::kId; };
    flight.bridge.order_flight();
    flight.run(0.5);
    flight.hides = nullptr;
    flight.run(1.6);
  };
  expect_nothing_is_overruled(story, kDoSetMode, Duration{-300'000});
}

TEST(WhoFlies, ASwitchBesideItsFirstCommandIsNotOverruled) {
  expect_nothing_is_overruled([](FlightInMemory& flight) { flight.run(6.0); }, kDoSetMode, Duration{0}, "LAND");
}

}  // namespace
}  // namespace tern::mavlink
