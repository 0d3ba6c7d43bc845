// tern-mission on virtual time: uploads, and what a restarted process flies.
#include "mission/app/mission_node.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <deque>

#include "runtime/virtual_runner.h"
#include "tests/mission/some_site.h"
#include "tests/support/temp_folder.h"
#include "tests/support/voxel_maps.h"

namespace tern::mission {
namespace {

using testing::site_without_origin;

/// The frames of a ground station, on their way. They outlive the processes that receive them.
using Cable = std::deque<mavlink::Bytes>;

class StationLink final : public mavlink::Link {
 public:
  StationLink(Cable& cable, std::vector<mavlink::Frame>& sent) : cable_(cable), sent_(sent) {}
  std::optional<mavlink::Portion> receive(UTime) override {
    if (cable_.empty()) return std::nullopt;
    mavlink::Portion portion{cable_.front(), std::nullopt};
    cable_.pop_front();
    return portion;
  }
  void send(std::span<const std::uint8_t> bytes) override {
    for (const mavlink::Frame& frame : parser_.push(bytes)) sent_.push_back(frame);
  }
  [[nodiscard]] bool datagrams() const override { return true; }

 private:
  Cable& cable_;
  mavlink::Parser parser_;
  std::vector<mavlink::Frame>& sent_;
};

Mission three_steps() {
  return {"m.csv",
          {{"a", 1, Action::Stop, {3, 2, 1}, 0.0, 0.0, 0},
           {"b", 2, Action::Stop, {5, 4, 1}, 0.0, 0.0, 0},
           {"c", 3, Action::Stop, {7, 2, 1}, 0.0, 0.0, 0}}};
}

/// tern-mission, a vehicle that is moved to each goal at once and repeats it at 1 Hz, and a mapper.
class MissionNodeTest : public ::testing::Test {
 protected:
  MissionNodeTest() {
    map_ = support::free_map({40, 40, 12});
    runner_.observer().subscribe(channels::kGoal, [this](const Goal& goal) {
      if (newest_ && goal.id <= newest_->id) return;
      newest_ = goal;
      if (goal.mode == GoalMode::Go) flown_to_.push_back(goal.position);
    });
  }

  /// Starts tern-mission, for an uploaded mission or for `mission`.
  void start(std::optional<Mission> mission = {}) {
    flown_to_.clear();
    node_ = &runner_.start("tern-mission", [&](Bus& bus) {
      MissionSetup setup;
      setup.mission = std::move(mission);
      setup.site = site_without_origin();
      setup.uav.flight_box = Box(Vec3::Zero(), Vec3(10, 10, 3));
      setup.folder = folder_.file("");
      setup.link = std::make_unique<StationLink>(cable_, sent_);
      return std::make_unique<MissionNode>(bus, std::move(setup));
    });
  }
  void restart() {
    runner_.stop("tern-mission");
    start();
  }
  /// Ends early if tern-mission ends.
  void run(double seconds) {
    for (const UTime end = runner_.now() + Duration::from_seconds(seconds); runner_.now() < end; ++ticks_) {
      if (newest_ && newest_->mode == GoalMode::Go) position_ = newest_->position;
      UavState state;
      state.at = runner_.now();
      state.motion.p = position_;
      runner_.observer().publish(channels::kUavState, state);
      VehicleStatus status;
      status.at = runner_.now();
      status.armed = status.following = true;
      runner_.observer().publish(channels::kVehicleStatus, status);
      if (ticks_ % 10 == 0) {
        for (const MapChunk& chunk : to_chunks(map_)) runner_.observer().publish(channels::kSemanticMap, chunk);
        if (newest_) runner_.observer().publish(channels::kGoal, *newest_);
      }
      if (runner_.run(runner_.now() + Duration{100'000}).end == RunEnd::Finished) return;
    }
  }

  template <class M>
  void send(const M& message) {
    cable_.push_back(mavlink::to_bytes(mavlink::to_frame(message, {255, 190}, 0)));
  }
  void upload(const Mission& mission) {
    auto items = items_of(mission.steps, site_without_origin());
    send(mavlink::MissionCount{static_cast<std::uint16_t>(items.size()), 1, 1, 0, 0});
    for (mavlink::MissionItemInt& item : items) {
      item.target_system = item.target_component = 1;
      send(item);
    }
  }
  /// The messages of this type that tern-mission has sent.
  template <class M>
  [[nodiscard]] std::vector<M> sent() const {
    std::vector<M> messages;
    for (const mavlink::Frame& frame : sent_) {
      if (const auto message = mavlink::from_frame<M>(frame)) messages.push_back(*message);
    }
    return messages;
  }
  [[nodiscard]] std::vector<int> reported() const {
    std::vector<int> seqs;
    for (const auto& message : sent<mavlink::MissionItemReached>()) seqs.push_back(message.seq);
    return seqs;
  }
  void order_start() {
    mavlink::CommandLong command;
    command.target_system = command.target_component = 1;
    command.command = 300;
    send(command);
  }
  void order_goal(const Vec3& position) {
    Goal goal;
    goal.id = newest_->id + 100'000;
    goal.position = position;
    newest_ = goal;
    runner_.observer().publish(channels::kGoal, goal);
  }
  void fly(const Mission& mission) {
    start();
    upload(mission);
    run(3.0);
    order_start();
    run(5.0);
    ASSERT_EQ(node_->health().state, ProcessState::Finished) << node_->health().waiting_for;
    ASSERT_EQ(flown_to_.size(), mission.steps.size());
  }

  TempFolder folder_;
  Cable cable_;
  std::vector<mavlink::Frame> sent_;
  VirtualRunner runner_;
  VoxelMap map_;
  const Node* node_ = nullptr;
  Vec3 position_{1, 2, 1};
  std::optional<Goal> newest_;
  std::vector<Vec3> flown_to_;
  int ticks_ = 0;
};

TEST_F(MissionNodeTest, AnUploadIsFlownOnceItIsStarted) {
  start();
  upload(three_steps());
  run(5.0);
  EXPECT_TRUE(flown_to_.empty());
  order_start();
  run(5.0);
  EXPECT_THAT(flown_to_, ::testing::ElementsAre(Vec3(3, 2, 1), Vec3(5, 4, 1), Vec3(7, 2, 1)));
}

TEST_F(MissionNodeTest, ARestartFliesNoUploadThatWasNotStarted) {
  start();
  upload(three_steps());
  run(3.0);
  restart();
  run(5.0);
  EXPECT_TRUE(flown_to_.empty());
  order_start();
  run(5.0);
  EXPECT_EQ(flown_to_.size(), 3u) << "it was kept";
}

TEST_F(MissionNodeTest, ARestartFliesNoMissionThatWasCleared) {
  start();
  upload(three_steps());
  run(3.0);
  send(mavlink::MissionClearAll{1, 1, 0});
  run(1.0);
  restart();
  run(5.0);
  EXPECT_TRUE(flown_to_.empty());
  EXPECT_THAT(node_->health().waiting_for, ::testing::HasSubstr("upload a mission"));
}

/// A look takes 100 frames. Of three looks the first ends with a mission, and the second takes it away. A report is due
/// every 50th look, so it meets each of the three.
TEST_F(MissionNodeTest, AMissionMayBeClearedWhileAReportIsDue) {
  start();
  run(1.0);
  const mavlink::MissionClearAll clear{1, 1, 0};
  for (int k = 0; k < 50; ++k) {
    for (int filler = 0; filler < 96; ++filler) send(clear);
    upload(three_steps());
    for (int filler = 0; filler < 200; ++filler) send(clear);
  }
  run(4.0);
  EXPECT_TRUE(cable_.empty());
  int cleared = 0;
  for (const auto& current : sent<mavlink::MissionCurrent>()) {
    if (current.total > 0) continue;
    ++cleared;
    EXPECT_EQ(current.mission_state, 1) << "there is no mission";
  }
  EXPECT_GT(cleared, 2);
}

TEST_F(MissionNodeTest, EachItemIsReportedAsReached) {
  fly(three_steps());
  EXPECT_THAT(reported(), ::testing::ElementsAre(0, 1, 2));
}

TEST_F(MissionNodeTest, ItemsOfAFileAreReportedAsTheyAreDownloaded) {
  Mission mission = three_steps();
  for (Step& step : mission.steps) step.item += 1;  // a take-off is the file's first item, and no step
  start(std::move(mission));
  run(5.0);
  EXPECT_THAT(reported(), ::testing::ElementsAre(0, 1, 2));
  EXPECT_EQ(sent<mavlink::MissionCurrent>().back().seq, 2);
}

TEST_F(MissionNodeTest, ARestartForgetsAnUploadThatIsBlocked) {
  start();
  upload(three_steps());
  run(3.0);
  const Eigen::Vector3i at = map_.grid.cell_of(Vec3(5, 4, 1));
  support::paint(map_, at, at, VoxelLabel::Occupied);
  restart();
  run(3.0);
  EXPECT_FALSE(node_->finished()) << "the ground station may upload another one";
  EXPECT_THAT(node_->health().waiting_for, ::testing::HasSubstr("upload a mission"));
  Mission other = three_steps();
  other.steps.erase(other.steps.begin() + 1);
  upload(other);
  run(1.0);
  order_start();
  run(5.0);
  EXPECT_THAT(flown_to_, ::testing::ElementsAre(Vec3(3, 2, 1), Vec3(7, 2, 1)));
}

TEST_F(MissionNodeTest, ARestartFliesNoMissionThatIsDone) {
  fly(three_steps());
  order_goal(Vec3(8, 8, 1));
  run(2.0);
  restart();
  run(5.0);
  EXPECT_TRUE(flown_to_.empty());
  EXPECT_EQ(node_->health().state, ProcessState::Finished);
  EXPECT_EQ(position_, Vec3(8, 8, 1));
}

TEST_F(MissionNodeTest, TheSameMissionUploadedAgainBeginsAtItsFirstStep) {
  fly(three_steps());
  flown_to_.clear();
  upload(three_steps());
  run(3.0);
  order_start();
  run(5.0);
  EXPECT_THAT(flown_to_, ::testing::ElementsAre(Vec3(3, 2, 1), Vec3(5, 4, 1), Vec3(7, 2, 1)));
}

TEST_F(MissionNodeTest, OnlyTheFirstProcessOfAMissionIsEndedByABlockedStep) {
  start(three_steps());
  run(2.5);
  ASSERT_FALSE(flown_to_.empty());
  runner_.stop("tern-mission");
  const Eigen::Vector3i at = map_.grid.cell_of(Vec3(5, 4, 1));
  support::paint(map_, at, at, VoxelLabel::Occupied);
  start(three_steps());
  run(2.0);
  EXPECT_FALSE(node_->finished()) << "later maps are the planner's affair";
}

TEST_F(MissionNodeTest, ABlockedStepEndsTheFirstProcess) {
  const Eigen::Vector3i at = map_.grid.cell_of(Vec3(5, 4, 1));
  support::paint(map_, at, at, VoxelLabel::Occupied);
  start(three_steps());
  run(2.0);
  EXPECT_EQ(node_->finished(), kExitCannotFly);
}

}  // namespace
}  // namespace tern::mission
