// External vision from which the autopilot's estimate is apart: not flown by.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mavlink/bridge.h"
#include "mavlink/vision_check.h"
#include "tests/mavlink/flight_in_memory.h"

namespace tern::mavlink {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;

const BridgeConfig kSees{.start = Start::Arm, .set_parameters = true, .external_vision = true};

TEST(Vision, AnEstimateThatComesBackMetresAwayAfterAGapOfTheLinkIsNotFollowedAndTheVehicleLands) {
  for (const float jump : {8.3F, 5.1F, 1.4F, -3.0F}) {
    FlightInMemory flight(kSees);
    ASSERT_TRUE(flight.run_until([&] { return flight.following(); })) << flight.bridge.status(flight.now).why_not;
    flight.set_parameter("SIM_EV_JUMP", jump);
    flight.path = along;
    flight.run(4.0);
    flight.cut = true;
    flight.run(0.42);
    flight.cut = false;
    std::string why;
    flight.each = [&] {
      const VehicleStatus status = flight.bridge.status(flight.now);
      if (why.empty() && !status.following && flight.bridge.stage() == Stage::Following) why = status.why_not;
      if (status.why_not.find("external vision") != std::string::npos) why = status.why_not;
      if (flight.bridge.stage() == Stage::Landing || flight.bridge.stage() == Stage::Landed) return;
      ASSERT_NEAR(flight.autopilot.model().truth().motion.p.z(), 2.0, 0.6) << "it neither dives nor climbs; " << jump;
    };
    ASSERT_TRUE(flight.run_until([&] { return flight.bridge.stage() == Stage::Landed; })) << jump;
    EXPECT_THAT(why, AllOf(HasSubstr(fmt::format("{:.1f} m {}", std::abs(jump), jump > 0 ? "above" : "below")),
                           HasSubstr("external vision"), HasSubstr("mavlink.vision_apart_m is 1")));
    EXPECT_THAT(flight.words, Contains(HasSubstr("landing: the autopilot's estimate is")));
    EXPECT_TRUE(flight.autopilot.model().truth().on_ground);
  }
}

TEST(Vision, AfterAShortGapItIsFollowed) {
  FlightInMemory flight(kSees);
  ASSERT_TRUE(flight.run_until([&] { return flight.following(); }));
  flight.cut = true;
  flight.run(0.23);
  flight.cut = false;
  flight.run(0.2);
  flight.each = [&] { ASSERT_TRUE(flight.following()) << flight.bridge.status(flight.now).why_not; };
  flight.run(5.0);
}

TEST(Vision, AnEstimateThatIsApartOnTheGroundIsNotArmedAndSaysSo) {
  for (const Vec3& by : {Vec3(1.2, 0, 0), Vec3(0, -1.2, 0), Vec3(0, 0, 1.2), Vec3(0, 0, -1.2)}) {
    FlightInMemory flight(kSees);
    flight.shifts = by;
    flight.run(15.0);
    EXPECT_FALSE(flight.autopilot.armed());
    EXPECT_THAT(flight.bridge.status(flight.now).why_not, HasSubstr("1.2 m")) << by.transpose();
    EXPECT_THAT(flight.bridge.status(flight.now).why_not, HasSubstr("external vision"));
    flight.shifts = Vec3::Zero();
    EXPECT_TRUE(flight.run_until([&] { return flight.following(); })) << flight.bridge.status(flight.now).why_not;
  }
}

TEST(Vision, AnEstimateThatPartsWhileArmingIsAskedForIsNotArmed) {
  FlightInMemory flight(kSees);
  flight.set_parameter("SIM_ARM_REFUSE", 1.0F);
  ASSERT_TRUE(flight.run_until([&] { return flight.bridge.stage() == Stage::Engaging; }));
  flight.run(2.0);
  flight.shifts = Vec3(0, 0, 1.2);
  flight.run(0.5);
  flight.set_parameter("SIM_ARM_REFUSE", 0.0F);
  flight.run(5.0);
  EXPECT_FALSE(flight.autopilot.armed());
  EXPECT_THAT(flight.bridge.status(flight.now).why_not, HasSubstr("1.2 m above the external vision"));
}

TEST(Vision, TheErrorThatWasMeasuredIsFlownAndTheBoundIsAKey) {
  for (const double bound : {1.0, 0.3}) {
    BridgeConfig config = kSees;
    config.vision_apart_m = bound;
    FlightInMemory flight(config);
    ASSERT_TRUE(flight.run_until([&] { return flight.following(); }));
    flight.shifts = Vec3(0.4, 0.4, 0.6);
    flight.run(5.0);
    EXPECT_EQ(flight.following(), bound == 1.0) << flight.bridge.status(flight.now).why_not;
  }
}

TEST(Vision, WithoutAnyToSendItIsNotFollowing) {
  FlightInMemory flight(kSees);
  ASSERT_TRUE(flight.run_until([&] { return flight.following(); }));
  flight.hides = [](const Frame& f) { return f.id == HilStateQuaternion::kId; };
  flight.run(0.7);
  EXPECT_THAT(flight.bridge.status(flight.now).why_not, HasSubstr("no external vision to send"));
}

UavState at(std::int64_t ms, const Vec3& p, const Vec3& v = Vec3::Zero()) {
  UavState state;
  state.at = UTime{1'000'000'000 + 1000 * ms};
  state.motion.p = p;
  state.motion.v = v;
  return state;
}

TEST(VisionCheck, ComparesAtTheTimeOfTheEstimate) {
  VisionCheck check(0.5);
  const Vec3 v(10, 0, 0);
  for (int ms = 0; ms <= 400; ms += 20) check.sent(at(ms, Vec3(0.01 * ms, 0, 0), v));
  for (int ms = 0; ms <= 450; ms += 10) check.estimated(at(ms, Vec3(0.01 * ms, 0, 0)), 0);
  EXPECT_EQ(check.fault(), "") << "at 10 m/s, though the newest vision is 50 ms old";
  EXPECT_EQ(check.apart_for(), Duration{});
}

TEST(VisionCheck, AShortDifferenceIsNoFaultUnlessTheEstimatorWasReset) {
  for (const int resets : {0, 1}) {
    VisionCheck check(0.5);
    check.sent(at(0, Vec3::Zero()));
    check.estimated(at(0, Vec3::Zero()), 0);
    check.estimated(at(10, Vec3(0, 0, 0.6)), resets);
    EXPECT_EQ(check.fault().empty(), resets == 0);
    check.estimated(at(90, Vec3(0, 0, 0.4)), resets);
    EXPECT_EQ(check.fault(), "");
  }
}

TEST(VisionCheck, WithoutVisionOfThatTimeTheAnswerStays) {
  VisionCheck check(0.5);
  for (int ms = 0; ms <= 400; ms += 20) {
    check.sent(at(ms, Vec3::Zero()));
    check.estimated(at(ms, Vec3(0.6, 0, 0)), 0);
  }
  const std::string fault = check.fault();
  EXPECT_THAT(fault, HasSubstr("0.6 m beside and 0.0 m above"));
  check.estimated(at(900, Vec3::Zero()), 0);
  EXPECT_EQ(check.fault(), fault);
}

}  // namespace
}  // namespace tern::mavlink
