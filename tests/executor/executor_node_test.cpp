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

/// An executor with a goal and a vehicle that stands near its start. The tubes of its requests.
class StandingVehicle : public ::testing::Test {
 protected:
  StandingVehicle() {
    runner_.start("tern-executor", [](Bus& bus) -> std::unique_ptr<Node> {
      return std::make_unique<ExecutorNode>(bus, UavSpec(), ExecutorConfig());
    });
    runner_.observer().subscribe(channels::kHorizonRequest, [&](const HorizonRequest& request) {
      tubes_.push_back(request.tube);
      v_max_ = request.limits.v_max;
    });
    Goal goal;
    goal.id = 1;
    goal.position = Vec3(10, 0, 1);
    runner_.observer().publish(channels::kGoal, goal);
  }
  /// For half a second.
  void stand(const Vec3& shift, std::int64_t resets, bool following) {
    for (int k = 0; k < 50; ++k) {
      UavState state;
      state.at = runner_.now();
      state.motion.p = UavSpec().start + shift;
      runner_.observer().publish(channels::kUavState, state);
      VehicleStatus status;
      status.at = runner_.now();
      status.armed = status.following = following;
      status.mode = "OFFBOARD";
      status.resets = resets;
      if (!following) status.why_not = "climbing";
      runner_.observer().publish(channels::kVehicleStatus, status);
      runner_.run(runner_.now() + Duration{10'000});
    }
  }

  VirtualRunner runner_;
  std::vector<Vec3> tubes_;
  Vec3 v_max_ = Vec3::Zero();  ///< of the newest request
};

TEST_F(StandingVehicle, KeepsTheSpeedLimitOfItsGoalAlone) {
  const auto limit = [&](std::int64_t goal, double speed) {
    SpeedLimit message;
    message.goal_id = goal;
    message.v_max = Vec3::Constant(speed);
    runner_.observer().publish(channels::kSpeedLimit, message);
  };
  const Vec3 own = UavSpec().limits.v_max;
  limit(2, 0.5);
  stand(Vec3::Zero(), 0, false);
  stand(Vec3::Zero(), 0, true);
  EXPECT_EQ(v_max_, own) << "of a goal to come";
  Goal goal;
  goal.id = 2;
  goal.position = Vec3(10, 0, 1);
  runner_.observer().publish(channels::kGoal, goal);
  stand(Vec3::Zero(), 0, true);
  EXPECT_EQ(v_max_, Vec3::Constant(0.5));
  limit(1, 0.1);
  limit(7, 2.0);
  stand(Vec3::Zero(), 0, true);
  EXPECT_EQ(v_max_, Vec3::Constant(0.5)) << "of a goal that is over, and of one to come";
  goal.id = 3;
  runner_.observer().publish(channels::kGoal, goal);
  stand(Vec3::Zero(), 0, true);
  EXPECT_EQ(v_max_, own);
}

TEST_F(StandingVehicle, IsPromisedAWiderTubeAfterTheEstimatorHasShiftedItInFlight) {
  stand(Vec3::Zero(), 0, false);
  stand(Vec3(0.0, 0.4, 0.0), 1, false);  // before it follows, W moves with the estimate
  stand(Vec3(0.0, 0.4, 0.0), 1, true);
  ASSERT_FALSE(tubes_.empty());
  EXPECT_NEAR(tubes_.back().y(), tubes_.back().x(), 1e-9);
  const Vec3 before = tubes_.back();
  stand(Vec3(0.5, 0.4, 0.0), 2, true);
  EXPECT_GE(tubes_.back().x(), before.x() + 0.5 - 1e-9);
}

TEST_F(StandingVehicle, IsNotHeldToErrorsOfACauseThatItHasReportedToBeOver) {
  const Vec3 off(0.0, 0.25, 0.0);
  stand(Vec3::Zero(), 0, false);
  stand(Vec3::Zero(), 0, true);
  ASSERT_FALSE(tubes_.empty());
  const Vec3 before = tubes_.back();
  stand(off, 0, true);
  EXPECT_GT(tubes_.back().y(), before.y());
  stand(off, 0, false);
  stand(off, 0, true);
  EXPECT_EQ(tubes_.back(), before);
}

}  // namespace
}  // namespace tern
