// A bridge that is killed and restarted while the vehicle flies: its published positions must not jump.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mavlink/axes.h"
#include "mavlink/bridge.h"
#include "tests/mavlink/flight_in_memory.h"

namespace tern::mavlink {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

/// Published minus true position, and the same for the position sent to the estimator.
struct Shift {
  std::vector<Vec3> truth, vision;
};

/// Flies, kills the bridge, and restarts it 0.2 s later. @return the shifts before and after
std::pair<Shift, Shift> shifts_over_a_restart(FlightInMemory& flight) {
  EXPECT_TRUE(flight.run_until([&] { return flight.following(); })) << flight.bridge.status(flight.now).why_not;
  flight.path = along;
  flight.run(4.0);
  Shift before, after;
  Shift* now = &before;
  flight.each = [&] {
    const auto truth = flight.bridge.truth();
    if (!truth || flight.now - truth->at > Duration{20'000}) return;
    const VehicleTruth is = flight.autopilot.model().truth();
    now->truth.emplace_back(truth->motion.p - is.motion.p + is.motion.v * (flight.now - truth->at).seconds());
  };
  flight.sent = [&](const Frame& frame) {
    const auto seen = from_frame<Odometry>(frame);
    if (seen) now->vision.emplace_back(enu_of(seen->p) - flight.autopilot.model().truth().motion.p);
  };
  flight.run(0.2);
  flight.bridge_runs = false;
  flight.run(0.2);
  flight.bridge_runs = true;
  flight.bridge = Bridge(flight.config, FlightInMemory::uav(), flight.now);
  now = &after;
  flight.run(3.0);
  EXPECT_GT(flight.autopilot.model().truth().motion.p.x(), 6.0);
  flight.each = nullptr;
  flight.sent = nullptr;
  return {before, after};
}

double farthest(const std::vector<Vec3>& from, const std::vector<Vec3>& to) {
  double most = from.empty() || to.empty() ? 1e9 : 0.0;
  for (const Vec3& a : from) {
    for (const Vec3& b : to) most = std::max(most, (a - b).norm());
  }
  return most;
}

TEST(StartedAnew, TheTruthThatItTellsTheEstimatorDoesNotStep) {
  FlightInMemory flight({.start = Start::Arm, .set_parameters = true, .external_vision = true});
  const auto [before, after] = shifts_over_a_restart(flight);
  EXPECT_LT(farthest(before.truth, after.truth), 0.15);
  EXPECT_LT(farthest(before.vision, after.vision), 0.15);
  EXPECT_THAT(flight.words, Contains(HasSubstr("in flight when first seen")));
}

TEST(StartedAnew, TheTruthThatItSaysDoesNotStepByWhatTheEstimateIsOff) {
  SimulatedAutopilotConfig drifting;
  drifting.estimator.drift_m = 0.5;
  drifting.estimator.drift_time_s = 1e5;
  FlightInMemory flight({.start = Start::Arm, .set_parameters = true}, drifting, 3);
  const auto [before, after] = shifts_over_a_restart(flight);
  EXPECT_GT(before.truth.front().norm(), 0.2) << "or else this shows nothing";
  EXPECT_LT(farthest(before.truth, after.truth), 0.15);
  EXPECT_THAT(flight.words, Contains(HasSubstr("in flight when first seen")));
}

/// An executor that goes on with its trajectory whether the vehicle follows or not.
void keep_flying_along(FlightInMemory& flight) {
  flight.speaks = false;
  const UTime since = flight.now;
  flight.each = [&flight, since] {
    UavState setpoint;
    setpoint.at = flight.now;
    setpoint.motion = along((flight.now - since).seconds());
    flight.bridge.receive(setpoint);
  };
}

TEST(StartedAnew, ItsFirstSetpointIsWhereTheVehicleIsAndItJoinsTheFlight) {
  // An autopilot sends HEARTBEAT once a second: the restart is at any time between two.
  for (const auto& [start, later_s] : {std::pair(Start::Arm, 0.0), std::pair(Start::Pilot, 0.2),
                                       std::pair(Start::Arm, 0.45), std::pair(Start::Pilot, 0.7)}) {
    FlightInMemory flight;
    ASSERT_TRUE(flight.run_until([&] { return flight.following(); }));
    keep_flying_along(flight);
    flight.run(4.0 + later_s);
    flight.config.start = start;
    flight.bridge_runs = false;
    flight.run(0.05);
    flight.bridge_runs = true;
    flight.bridge = Bridge(flight.config, FlightInMemory::uav(), flight.now);
    int sent = 0;
    flight.sent = [&](const Frame& frame) {
      const auto target = from_frame<SetPositionTargetLocalNed>(frame);
      if (!target) return;
      ++sent;
      ASSERT_LT((enu_of(target->p) - flight.autopilot.model().truth().motion.p).norm(), 0.8);
    };
    const UTime begun = flight.now;
    ASSERT_TRUE(flight.run_until([&] { return flight.following(); }, 5.0));
    EXPECT_LT((flight.now - begun).seconds(), 0.5) << "no time is lost until its setpoints are believed";
    flight.run(3.0);
    EXPECT_TRUE(flight.following());
    EXPECT_GT(sent, 100);
  }
}

TEST(StartedAnew, OrderedToFlyAgainItHoldsWhereTheVehicleIsNow) {
  FlightInMemory flight;
  ASSERT_TRUE(flight.run_until([&] { return flight.following(); }));
  flight.path = along;
  flight.run(4.0);
  flight.bridge.land("the flight has ended");
  ASSERT_TRUE(flight.run_until([&] { return flight.bridge.stage() == Stage::Landed; }));
  flight.bridge.order_flight();
  int sent = 0;
  flight.sent = [&](const Frame& frame) {
    const auto target = from_frame<SetPositionTargetLocalNed>(frame);
    if (!target || flight.autopilot.armed()) return;
    ++sent;
    ASSERT_LT((enu_of(target->p) - flight.autopilot.model().truth().motion.p).norm(), 0.3);
  };
  flight.run(2.0);
  EXPECT_GT(sent, 10);
}

TEST(StartedAnew, ASetpointOfAnExecutorThatHasEndedIsNotFlown) {
  FlightInMemory flight;
  flight.speaks = false;
  ASSERT_TRUE(flight.run_until([&] { return flight.bridge.stage() == Stage::Following; }));
  UavState old;
  old.at = flight.now - Duration{1'000'000};
  old.motion.p = Vec3(0, 1, 2);
  flight.bridge.receive(old);
  flight.run(0.1);
  EXPECT_THAT(flight.bridge.status(flight.now).why_not, HasSubstr("no SETPOINT was received"));
}

TEST(StartedAnew, OnTheGroundItIsTheGroundThatDecides) {
  FlightInMemory flight;
  ASSERT_TRUE(flight.run_until([&] { return flight.following(); }));
  EXPECT_THAT(flight.words, Not(Contains(HasSubstr("in flight when first seen"))));
}

}  // namespace
}  // namespace tern::mavlink
