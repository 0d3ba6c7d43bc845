// The executor's node before a vehicle of whose estimate the test decides.
#include "executor/app/executor_node.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "messages/codec.h"
#include "runtime/virtual_runner.h"

namespace tern {
namespace {

TEST(ExecutorNode, TheHeadingBeginsWhereItIsMeasuredWhenFollowingBeginsAndIsNotTakenAnewInFlight) {
  VirtualRunner runner;
  runner.start("tern-executor", [](Bus& bus) -> std::unique_ptr<Node> {
    return std::make_unique<ExecutorNode>(bus, UavSpec(), ExecutorConfig());
  });
  std::vector<double> yaws;
  runner.observer().subscribe(channels::kSetpoint, [&](const UavState& setpoint) { yaws.push_back(setpoint.yaw); });
  const auto stand = [&](double yaw, bool following, int steps) {
    for (int k = 0; k < steps; ++k) {
      UavState state;
      state.at = runner.now();
      state.motion.p = UavSpec().start;
      state.yaw = yaw;
      runner.observer().publish(channels::kUavState, state);
      VehicleStatus status;
      status.at = runner.now();
      status.armed = status.following = following;
      status.mode = "OFFBOARD";
      if (!following) status.why_not = "climbing";
      runner.observer().publish(channels::kVehicleStatus, status);
      runner.run(runner.now() + Duration{10'000});
    }
  };
  stand(0.1, false, 50);
  stand(0.45, false, 50);  // the estimator has found its north
  ASSERT_FALSE(yaws.empty());
  stand(0.45, true, 2);
  EXPECT_NEAR(yaws.back(), 0.45, 1e-9);
  yaws.clear();
  stand(1.2, true, 50);
  stand(1.2, false, 50);
  stand(1.2, true, 50);
  for (const double yaw : yaws) ASSERT_NEAR(yaw, 0.45, 1e-9) << "it flies: the heading is the setpoints' alone";
}

}  // namespace
}  // namespace tern
