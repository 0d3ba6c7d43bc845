// The executor's node with a vehicle whose estimate is set by the test.
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
  stand(0.45, false, 50);  // the estimator has corrected its heading
  ASSERT_FALSE(yaws.empty());
  stand(0.45, true, 2);
  EXPECT_NEAR(yaws.back(), 0.45, 1e-9);
  yaws.clear();
  stand(1.2, true, 50);
  stand(1.2, false, 50);
  stand(1.2, true, 50);
  for (const double yaw : yaws) ASSERT_NEAR(yaw, 0.45, 1e-9) << "it flies: the heading is the setpoints' alone";
}

TEST(ExecutorNode, PromisesAWiderTubeAfterTheEstimatorHasShiftedTheVehicleInFlight) {
  VirtualRunner runner;
  runner.start("tern-executor", [](Bus& bus) -> std::unique_ptr<Node> {
    return std::make_unique<ExecutorNode>(bus, UavSpec(), ExecutorConfig());
  });
  std::vector<Vec3> tubes;
  runner.observer().subscribe(channels::kHorizonRequest,
                              [&](const HorizonRequest& request) { tubes.push_back(request.tube); });
  Goal goal;
  goal.id = 1;
  goal.position = Vec3(10, 0, 1);
  runner.observer().publish(channels::kGoal, goal);
  const auto stand = [&](const Vec3& shift, std::int64_t resets, bool following) {
    for (int k = 0; k < 50; ++k) {
      UavState state;
      state.at = runner.now();
      state.motion.p = UavSpec().start + shift;
      runner.observer().publish(channels::kUavState, state);
      VehicleStatus status;
      status.at = runner.now();
      status.armed = status.following = following;
      status.mode = "OFFBOARD";
      status.resets = resets;
      if (!following) status.why_not = "climbing";
      runner.observer().publish(channels::kVehicleStatus, status);
      runner.run(runner.now() + Duration{10'000});
    }
  };
  stand(Vec3::Zero(), 0, false);
  stand(Vec3(0.0, 0.4, 0.0), 1, false);  // before it follows, W moves with the estimate
  stand(Vec3(0.0, 0.4, 0.0), 1, true);
  ASSERT_FALSE(tubes.empty());
  EXPECT_NEAR(tubes.back().y(), tubes.back().x(), 1e-9);
  const Vec3 before = tubes.back();
  stand(Vec3(0.5, 0.4, 0.0), 2, true);
  EXPECT_GE(tubes.back().x(), before.x() + 0.5 - 1e-9);
}

}  // namespace
}  // namespace tern
