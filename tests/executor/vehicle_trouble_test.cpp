// The executor's node with a vehicle that dies, lies, or flies in another frame.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "executor/app/executor_node.h"
#include "messages/codec.h"
#include "runtime/virtual_runner.h"

namespace tern {
namespace {

using testing::HasSubstr;

UavSpec vehicle_spec() {
  UavSpec uav;
  uav.start = Vec3(0, 0, 1);
  uav.goal = Vec3(15, 0, 1);
  uav.limits.v_max = Vec3::Constant(2.0);
  uav.limits.a_max = Vec3::Constant(4.0);
  uav.flight_box = Box(Vec3(-3, -6, 0), Vec3(20, 6, 4));
  return uav;
}

/// An executor, and a vehicle that is wherever the test says: by default at its newest setpoint.
class VehicleTrouble : public ::testing::Test {
 protected:
  VehicleTrouble() {
    node_ = static_cast<ExecutorNode*>(&runner_.start("tern-executor", [](Bus& bus) -> std::unique_ptr<Node> {
      return std::make_unique<ExecutorNode>(bus, vehicle_spec(), ExecutorConfig());
    }));
    Bus& bus = runner_.observer();
    bus.subscribe(channels::kSetpoint, [&](const UavState& setpoint) {
      setpoint_ = setpoint;
      farthest_ = std::max(farthest_, (setpoint.motion.p - vehicle_spec().start).norm());
      ++setpoints_;
    });
    bus.subscribe(channels::kHorizonRequest, [&](const HorizonRequest& request) { requests_.push_back(request); });
    setpoint_.motion.p = vehicle_spec().start;
    Goal goal;
    goal.id = 1;
    goal.position = vehicle_spec().goal;
    bus.publish(channels::kGoal, goal);
  }

  /// Lets the vehicle report for so long: each 10 ms a state, each 100 ms a status.
  void fly(double seconds) {
    const UTime end = runner_.now() + Duration::from_seconds(seconds);
    while (runner_.now() < end) {
      if (sends_state_) {
        UavState state = setpoint_;
        state.at = runner_.now() - state_age_;
        state.motion.p = measured_(setpoint_.motion.p);
        runner_.observer().publish(channels::kUavState, state);
      }
      if (sends_status_ && step_++ % 10 == 0) {
        VehicleStatus status;
        status.at = runner_.now();
        status.armed = status.following = true;
        status.mode = "OFFBOARD";
        runner_.observer().publish(channels::kVehicleStatus, status);
      }
      runner_.run(runner_.now() + Duration{10'000});
    }
  }
  /// Sends one HEARTBEAT of tern-mapper. @param is_live  whether it receives scans
  void send_mapper(ProcessState state, const std::string& waiting_for, bool is_live) {
    Heartbeat heartbeat;
    heartbeat.process = "tern-mapper";
    heartbeat.state = state;
    heartbeat.waiting_for = waiting_for;
    heartbeat.channels[channels::kSemanticMap.name].sent = 1;
    if (is_live) heartbeat.channels[channels::kPointCloud.name].received = 1;
    runner_.observer().publish(channels::kHeartbeat, heartbeat);
  }
  /// Requests made while the vehicle flies on.
  std::size_t requests_in(double seconds) {
    const std::size_t before = requests_.size();
    fly(seconds);
    return requests_.size() - before;
  }

  VirtualRunner runner_;
  ExecutorNode* node_ = nullptr;
  std::vector<HorizonRequest> requests_;
  UavState setpoint_;
  std::int64_t setpoints_ = 0;
  double farthest_ = 0.0;
  bool sends_state_ = true, sends_status_ = true;
  Duration state_age_{0};
  std::function<Vec3(const Vec3&)> measured_ = [](const Vec3& p) { return p; };
  int step_ = 0;
};

TEST_F(VehicleTrouble, WithoutAStateNothingIsRequestedAndHeartbeatSaysSo) {
  fly(1.0);
  EXPECT_GT(requests_in(1.0), 10u);
  sends_state_ = false;
  fly(0.4);
  EXPECT_EQ(requests_in(1.0), 0u);
  EXPECT_EQ(node_->health().state, ProcessState::Waiting);
  EXPECT_THAT(node_->health().waiting_for, HasSubstr("UAV_STATE is silent for 1."));
  sends_state_ = true;
  fly(0.1);
  EXPECT_GT(requests_in(1.0), 10u) << "it goes on when the state is back";
  EXPECT_EQ(node_->health().state, ProcessState::Ready);
}

TEST_F(VehicleTrouble, WithoutAStatusNothingIsRequested) {
  fly(1.0);
  sends_status_ = false;
  fly(0.4);
  EXPECT_EQ(requests_in(1.0), 0u);
  EXPECT_THAT(node_->health().waiting_for, HasSubstr("VEHICLE_STATUS is silent"));
  const std::int64_t before = setpoints_;
  fly(1.0);
  EXPECT_GT(setpoints_, before + 50) << "the committed trajectory is flown to its end, and rested at";
}

TEST_F(VehicleTrouble, BeforeTheFirstStatusNothingIsRequested) {
  sends_status_ = false;
  EXPECT_EQ(requests_in(2.0), 0u);
  EXPECT_EQ(farthest_, 0.0);
  EXPECT_EQ(node_->health().state, ProcessState::Waiting);
  EXPECT_EQ(node_->health().waiting_for, "VEHICLE_STATUS is silent so far");
  sends_status_ = true;
  fly(0.3);
  EXPECT_GT(requests_in(1.0), 10u);
}

TEST_F(VehicleTrouble, AStateThatIsOldIsNoState) {
  fly(1.0);
  state_age_ = Duration{2'000'000};
  fly(0.4);
  EXPECT_EQ(requests_in(1.0), 0u);
  EXPECT_THAT(node_->health().waiting_for, testing::MatchesRegex("UAV_STATE is [12]\\.[0-9] s old"));
}

TEST_F(VehicleTrouble, AStateThatIsRefusedIsNamedWithItsReason) {
  fly(1.0);
  state_age_ = Duration{-1'000'000};  // ahead of every clock
  fly(1.0);
  EXPECT_EQ(requests_in(1.0), 0u);
  EXPECT_THAT(node_->health().waiting_for, HasSubstr("(refused: future)"));
}

TEST_F(VehicleTrouble, WithoutAStatusAnOffsetMovesNoSetpoint) {
  fly(1.0);
  sends_status_ = false;
  measured_ = [](const Vec3& p) { return Vec3(p + Vec3(0, 3, 0)); };
  fly(0.4);
  const double before = farthest_;
  fly(20.0);
  EXPECT_LE(farthest_, before + 1e-9);
}

TEST_F(VehicleTrouble, WithALiveMapThatIsNotKeptUpToDateNothingIsRequested) {
  send_mapper(ProcessState::Ready, "", true);
  fly(1.0);
  EXPECT_GT(requests_in(1.0), 10u);
  send_mapper(ProcessState::Waiting, "scans: the last usable one came 2 s ago", true);
  fly(0.1);
  EXPECT_EQ(requests_in(1.0), 0u);
  EXPECT_EQ(node_->health().state, ProcessState::Waiting);
  EXPECT_THAT(node_->health().waiting_for, HasSubstr("tern-mapper waits for scans: the last usable one came 2 s ago"));
  send_mapper(ProcessState::Ready, "", true);
  EXPECT_GT(requests_in(1.0), 10u) << "it goes on when scans come again";
  EXPECT_EQ(node_->health().state, ProcessState::Ready);
}

TEST_F(VehicleTrouble, ALiveMapWhoseMapperIsSilentIsNotKept) {
  send_mapper(ProcessState::Ready, "", true);
  fly(3.1);
  EXPECT_EQ(requests_in(1.0), 0u);
  EXPECT_THAT(node_->health().waiting_for, HasSubstr("tern-mapper is silent for 4."));
  const std::int64_t before = setpoints_;
  fly(1.0);
  EXPECT_GT(setpoints_, before + 50) << "the committed trajectory is flown to its end, and rested at";
}

TEST_F(VehicleTrouble, AMapOfFilesHasNoAge) {
  send_mapper(ProcessState::Ready, "", false);
  fly(5.0);
  EXPECT_GT(requests_in(1.0), 10u);
}

class OffsetEstimate : public VehicleTrouble, public ::testing::WithParamInterface<double> {};

TEST_P(OffsetEstimate, LeadsTheVehicleNoFartherThanTheGuardAllows) {
  const double offset = GetParam();
  fly(1.0);
  measured_ = [offset](const Vec3& p) { return Vec3(p + Vec3(0, offset, 0)); };
  fly(20.0);
  EXPECT_LE(farthest_, RejoinGuard::kMaxShift + offset + 1.0);
  for (const HorizonRequest& request : requests_) {
    ASSERT_LE(request.flight_box.max().y(), 6.0 + RejoinGuard::kMaxExcursion + RejoinGuard::kExcursionStep + 0.5);
  }
  EXPECT_THAT(node_->lost(), HasSubstr("does not follow its setpoints"));
  EXPECT_EQ(node_->health().state, ProcessState::Failed);
  const std::int64_t before = setpoints_;
  fly(1.0);
  EXPECT_EQ(setpoints_, before) << "no setpoint leaves after that";
}

INSTANTIATE_TEST_SUITE_P(Metres, OffsetEstimate, ::testing::Values(0.6, 1.0, 3.0));

TEST_F(VehicleTrouble, ADriftOfTheEstimateEndsAtTheFlightBox) {
  double drift = 0.0;
  measured_ = [&drift](const Vec3& p) { return Vec3(p + Vec3(0, drift, 0)); };
  fly(1.0);
  for (int k = 0; k < 600 && node_->lost().empty(); ++k) {
    drift += 0.1;
    fly(1.0);
  }
  EXPECT_FALSE(node_->lost().empty());
  EXPECT_LE(farthest_, 12.0);
}

TEST_F(VehicleTrouble, AVehicleInAnotherFrameOrUnitDoesNotStart) {
  measured_ = [](const Vec3& p) { return Vec3(p.y(), p.x(), -p.z()); };  // NED
  fly(5.0);
  EXPECT_EQ(node_->executor(), nullptr);
  EXPECT_EQ(setpoints_, 0);
  EXPECT_THAT(node_->health().waiting_for, HasSubstr("are frame and unit of UAV_STATE right?"));
  measured_ = [](const Vec3& p) { return Vec3(1000.0 * p); };
  fly(5.0);
  EXPECT_EQ(setpoints_, 0);
  measured_ = [](const Vec3& p) { return p; };
  fly(1.0);
  EXPECT_GT(requests_in(1.0), 10u) << "it starts when the state is right";
}

TEST_F(VehicleTrouble, AGoalWithAnIdInUseIsRefusedAndCounted) {
  fly(1.0);
  Goal other;
  other.id = 1;
  other.position = Vec3(-2, 0, 1);
  std::vector<Goal> repeated;
  runner_.observer().subscribe(channels::kGoal, [&](const Goal& goal) { repeated.push_back(goal); });
  runner_.observer().publish(channels::kGoal, other);
  fly(2.0);
  ASSERT_GE(repeated.size(), 2u);
  EXPECT_EQ(repeated.back().position, vehicle_spec().goal);
  EXPECT_THAT(node_->health().waiting_for, HasSubstr("refused a goal: its id 1 is in use"));
}

}  // namespace
}  // namespace tern
