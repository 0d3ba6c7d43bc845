// The bridge with a dead estimate, and with an estimate away from the planned start.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mavlink/axes.h"
#include "mavlink/bridge.h"
#include "tests/mavlink/flight_in_memory.h"

namespace tern::mavlink {
namespace {

using testing::HasSubstr;

TEST(Estimate, AVehicleThatSaysNoPositionAnyMoreIsNotFollowingAndIsBroughtToRest) {
  SimulatedAutopilotConfig autopilot;
  autopilot.tuned = true;  // with PX4's own, softer gains it rests later
  FlightInMemory flight({.start = Start::Arm, .set_parameters = true}, autopilot);
  ASSERT_TRUE(flight.run_until([&] { return flight.following(); }));
  flight.path = along;
  flight.run(4.0);
  ASSERT_TRUE(flight.following());
  flight.hides = [](const Frame& f) { return f.id == Odometry::kId || f.id == LocalPositionNed::kId; };
  std::vector<Vec3> told;
  flight.sent = [&](const Frame& frame) {
    if (const auto target = from_frame<SetPositionTargetLocalNed>(frame)) told.push_back(enu_of(target->p));
  };
  flight.run(0.7);
  EXPECT_FALSE(flight.following());
  EXPECT_THAT(flight.bridge.status(flight.now).why_not, HasSubstr("it reports no position"));
  flight.run(3.0);
  EXPECT_LT(flight.autopilot.model().truth().motion.v.norm(), 0.1);
  for (std::size_t k = 1; k < told.size(); ++k) ASSERT_GT(told[k].x(), told[k - 1].x() - 1e-3) << "nowhere back";
  flight.hides = nullptr;
  EXPECT_TRUE(flight.run_until([&] { return flight.following(); }, 2.0)) << "it goes on when the estimate is back";
}

TEST(Estimate, AVehicleWhoseEstimatorHasLostItsPositionIsNotFollowing) {
  FlightInMemory flight;
  ASSERT_TRUE(flight.run_until([&] { return flight.following(); }));
  flight.hides = [](const Frame& f) { return f.id == EstimatorStatus::kId; };
  const auto say_lost = [&] { flight.bridge.receive(to_frame(EstimatorStatus{.flags = 1}, {1, 1}, 0), flight.now); };
  say_lost();
  EXPECT_TRUE(flight.following()) << "a fault of an input takes the flags for a moment";
  flight.run(0.5);
  say_lost();
  EXPECT_TRUE(flight.following());
  flight.run(0.6);
  say_lost();
  EXPECT_FALSE(flight.following());
  EXPECT_THAT(flight.bridge.status(flight.now).why_not, HasSubstr("its estimator has no position"));
}

TEST(Estimate, AVehicleThatStandsAboveItsStartIsNotArmed) {
  FlightInMemory flight;
  flight.shifts = Vec3(0.0, 0.0, 2.5);
  flight.run(12.0);
  EXPECT_EQ(flight.bridge.stage(), Stage::Ready);
  EXPECT_THAT(flight.bridge.status(flight.now).why_not, HasSubstr("the vehicle stands at a height of 2.5 m"));
  EXPECT_THAT(flight.bridge.status(flight.now).why_not, HasSubstr("uav.start is at 2.0 m"));
  EXPECT_FALSE(flight.autopilot.armed());
  flight.shifts = Vec3::Zero();
  EXPECT_TRUE(flight.run_until([&] { return flight.following(); }));
}

}  // namespace
}  // namespace tern::mavlink
