// The bridge's process on virtual time, beside the simulated autopilot: how it ends, and what it hears of
// tern-executor.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <deque>

#include "mavlink/app/mavlink_node.h"
#include "mavlink/sim/simulated_autopilot.h"
#include "messages/codec.h"
#include "runtime/virtual_runner.h"

namespace tern::mavlink {
namespace {

using testing::HasSubstr;

/// A link without delay to an autopilot that is stepped as the bridge looks.
class MemoryLink final : public Link {
 public:
  explicit MemoryLink(UTime now) : autopilot({}, 1, now) {}
  std::optional<Portion> receive(UTime now) override {
    autopilot.receive(to_frame(tern::mavlink::Heartbeat{.type = 6}, {255, 190}, 0), now, false);
    autopilot.step(now_ = now);
    for (const Frame& frame : autopilot.take_frames()) {
      if (!cut) arrived_.push_back(to_bytes(frame));
    }
    if (arrived_.empty()) return std::nullopt;
    Portion portion{arrived_.front(), std::nullopt};
    arrived_.pop_front();
    return portion;
  }
  void send(std::span<const std::uint8_t> bytes) override {
    if (cut) return;
    for (const Frame& frame : parser_.push({bytes.begin(), bytes.end()})) {
      visions += frame.id == Odometry::kId ? 1 : 0;
      autopilot.receive(frame, now_);
    }
  }
  [[nodiscard]] bool datagrams() const override { return true; }
  void command(CommandLong command) {
    command.target_system = 1;
    autopilot.receive(to_frame(command, {255, 190}, 0), now_, false);
  }

  SimulatedAutopilot autopilot;
  bool cut = false;
  int visions = 0;  ///< ODOMETRY that the bridge sent

 private:
  UTime now_;
  Parser parser_;
  std::deque<Bytes> arrived_;
};

class BridgeNode : public testing::Test {
 protected:
  BridgeNode() {
    UavSpec uav;
    uav.start = Vec3(0, 0, 2);
    uav.limits.v_max.z() = 1.5;
    uav.limits.dynamics.emplace();
    const BridgeConfig config{
        .start = Start::Arm, .set_parameters = true, .without_remote = true, .external_vision = true};
    node_ = &runner_.start("tern-mavlink", [&](Bus& bus) {
      auto link = std::make_unique<MemoryLink>(bus.clock().now());
      link_ = link.get();
      return std::make_unique<MavlinkNode>(bus, std::move(link), uav, config, std::nullopt);
    });
    runner_.observer().subscribe(channels::kVehicleStatus, [this](const VehicleStatus& s) { status_ = s; });
  }
  /// An armed vehicle would be landed by the node's destructor, which waits by the system's clock.
  void TearDown() override {
    (void)node_->end(runner_.now());
    run(2.0);
    (void)node_->end(runner_.now());
  }
  bool until(const std::function<bool()>& condition, double seconds = 60.0) {
    runner_.run(runner_.now() + Duration::from_seconds(seconds), condition);
    return condition();
  }
  void run(double seconds) { runner_.run(runner_.now() + Duration::from_seconds(seconds)); }
  bool until_climbed() {
    return until([&] { return status_.why_not == "no SETPOINT was received"; });
  }

  VirtualRunner runner_;
  MemoryLink* link_ = nullptr;
  Node* node_ = nullptr;
  VehicleStatus status_;
};

const CommandLong kPilot{.param = {1, 3, 0}, .command = kDoSetMode};

TEST_F(BridgeNode, AskedToEndWhileItFliesLandsAndEndsDisarmed) {
  ASSERT_TRUE(until_climbed()) << status_.why_not;
  EXPECT_FALSE(node_->end(runner_.now()));
  run(1.0);
  EXPECT_FALSE(node_->finished());
  ASSERT_TRUE(until([&] { return node_->finished().has_value(); }));
  EXPECT_EQ(node_->finished(), 0);
  EXPECT_FALSE(link_->autopilot.armed());
  EXPECT_FALSE(status_.armed) << "the last status says so";
}

TEST_F(BridgeNode, AskedToEndWhileAPilotFliesServesThemUntilTheVehicleIsDisarmed) {
  ASSERT_TRUE(until_climbed());
  link_->command(kPilot);
  ASSERT_TRUE(until([&] { return status_.mode == "POSCTL"; }));
  EXPECT_FALSE(node_->end(runner_.now()));
  link_->visions = 0;
  run(60.0);
  EXPECT_FALSE(node_->finished()) << "the vehicle hovers";
  EXPECT_EQ(link_->autopilot.mode(), "POSCTL");
  EXPECT_GT(link_->visions, 60 * 40) << "the pilot flies on external vision";
  link_->command({.command = kNavLand});
  ASSERT_TRUE(until([&] { return node_->finished().has_value(); }));
  EXPECT_EQ(node_->finished(), 0);
  EXPECT_FALSE(link_->autopilot.armed());
}

/// tern-mission may send a goal before it knows that a pilot has taken over.
TEST_F(BridgeNode, AGoalThatWasUnderWayTakesNothingFromAPilot) {
  ASSERT_TRUE(until_climbed());
  Goal goal;
  goal.id = 1;
  goal.position = Vec3(5, 0, 2);
  runner_.observer().publish(channels::kGoal, goal);
  run(1.0);
  ASSERT_EQ(link_->autopilot.mode(), "OFFBOARD");
  link_->command(kPilot);
  ASSERT_TRUE(until([&] { return status_.mode == "POSCTL"; }));
  goal.id = 2;
  runner_.observer().publish(channels::kGoal, goal);
  run(5.0);
  EXPECT_EQ(link_->autopilot.mode(), "POSCTL");
  goal.id = 3;
  runner_.observer().publish(channels::kGoal, goal);
  EXPECT_TRUE(until([&] { return link_->autopilot.mode() == "OFFBOARD"; }, 10.0)) << "an order of afterwards counts";
}

TEST_F(BridgeNode, AGoalFromBeforeItsStartWithdrawsTheOrderToArmAndANewOneGivesIt) {
  Goal goal;
  goal.id = runner_.now().us - 1;
  goal.position = Vec3(5, 0, 2);
  runner_.observer().publish(channels::kGoal, goal);
  run(8.0);
  EXPECT_FALSE(link_->autopilot.armed()) << "the flight may be over";
  goal.id = runner_.now().us;
  runner_.observer().publish(channels::kGoal, goal);
  EXPECT_TRUE(until_climbed());
}

TEST_F(BridgeNode, AFirstGoalBeforeItHasArmedIsAnOrderLikeItsOwn) {
  run(0.1);
  Goal goal;
  goal.id = runner_.now().us;
  goal.position = Vec3(5, 0, 2);
  runner_.observer().publish(channels::kGoal, goal);
  EXPECT_TRUE(until_climbed()) << status_.why_not;
}

TEST_F(BridgeNode, AfterTernExecutorHasFailedNoGoalOrdersAFlight) {
  tern::Heartbeat heartbeat;
  heartbeat.process = "tern-executor";
  heartbeat.state = ProcessState::Failed;
  runner_.observer().publish(channels::kHeartbeat, heartbeat);
  run(0.1);
  Goal goal;
  goal.id = runner_.now().us;
  goal.position = Vec3(5, 0, 2);
  runner_.observer().publish(channels::kGoal, goal);
  run(8.0);
  EXPECT_FALSE(link_->autopilot.armed());
  heartbeat.state = ProcessState::Ready;
  runner_.observer().publish(channels::kHeartbeat, heartbeat);
  goal.id = runner_.now().us;
  runner_.observer().publish(channels::kGoal, goal);
  EXPECT_TRUE(until_climbed()) << "it was started anew";
}

TEST_F(BridgeNode, AskedAgainItEndsAndTellsThatTheVehicleIsArmed) {
  ASSERT_TRUE(until_climbed());
  link_->command(kPilot);
  ASSERT_TRUE(until([&] { return status_.mode == "POSCTL"; }));
  EXPECT_FALSE(node_->end(runner_.now()));
  EXPECT_FALSE(node_->end(runner_.now())) << "a Ctrl-C may come twice at a time";
  run(1.5);
  EXPECT_FALSE(node_->finished());
  EXPECT_FALSE(node_->end(runner_.now()));
  EXPECT_EQ(node_->finished(), MavlinkNode::kExitArmed);
}

TEST_F(BridgeNode, AnAutopilotThatIsSilentIsNotWaitedForLong) {
  ASSERT_TRUE(until_climbed());
  EXPECT_FALSE(node_->end(runner_.now()));
  link_->cut = true;
  run(9.0);
  EXPECT_FALSE(node_->finished());
  run(2.0);
  EXPECT_EQ(node_->finished(), MavlinkNode::kExitArmed);
}

TEST_F(BridgeNode, AskedToEndOnTheGroundItEnds) {
  run(1.0);
  EXPECT_FALSE(node_->end(runner_.now()));
  run(2.0);
  EXPECT_EQ(node_->finished(), 0);
}

TEST_F(BridgeNode, AnExecutorThatIsLostHasTheVehicleLanded) {
  ASSERT_TRUE(until_climbed());
  tern::Heartbeat heartbeat;
  heartbeat.process = "tern-executor";
  heartbeat.state = ProcessState::Waiting;
  runner_.observer().publish(channels::kHeartbeat, heartbeat);
  run(1.0);
  EXPECT_EQ(link_->autopilot.mode(), "OFFBOARD");
  heartbeat.state = ProcessState::Failed;
  heartbeat.waiting_for = "the vehicle does not follow its setpoints";
  runner_.observer().publish(channels::kHeartbeat, heartbeat);
  ASSERT_TRUE(until([&] { return link_->autopilot.mode() == "AUTO.LAND"; }, 2.0));
  run(0.2);  // VEHICLE_STATUS has 10 Hz
  EXPECT_THAT(status_.why_not, HasSubstr("tern-executor has given the vehicle up: the vehicle does not follow"));
  EXPECT_TRUE(until([&] { return !link_->autopilot.armed(); }));
}

}  // namespace
}  // namespace tern::mavlink
