// tern-mission on virtual time: uploads, and what a restarted process flies.
#include "mission/app/mission_node.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "core/world/uploaded_fences.h"
#include "runtime/virtual_runner.h"
#include "tests/mission/some_site.h"
#include "tests/mission/station_link.h"
#include "tests/support/temp_folder.h"
#include "tests/support/voxel_maps.h"

namespace tern::mission {
namespace {

using testing::Cable;
using testing::fence_item;
using testing::site_without_origin;
using testing::StationLink;

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
    runner_.observer().subscribe(channels::kFences, [this](const FenceSet& set) { heard_.push_back(set.fences); });
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
      if (has_folder_) setup.folder = folder_.file("");
      setup.fence_uploads = takes_fences_;
      setup.start_on_upload = starts_on_upload_;
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
        for (const MapChunk& chunk : to_chunks(fenced_map())) runner_.observer().publish(channels::kSemanticMap, chunk);
        if (newest_) runner_.observer().publish(channels::kGoal, *newest_);
      }
      if (runner_.run(runner_.now() + Duration{100'000}).end == RunEnd::Finished) return;
    }
  }

  /// The map with the fences that the mapper has heard.
  [[nodiscard]] VoxelMap fenced_map() const {
    VoxelMap map = map_;
    if (!maps_fences_ || heard_.empty()) return map;
    add_uploaded_fences(uploaded_fence_labels(heard_.back(), map.grid, Box(Vec3::Zero(), Vec3(10, 10, 3))).value(),
                        map);
    return map;
  }

  template <class M>
  void send(const M& message) {
    testing::send(cable_, message);
  }
  void upload(const Mission& mission) {
    testing::upload(cable_, items_of(mission.steps, site_without_origin()), kMissionType);
  }
  void upload_fences(const std::vector<mavlink::MissionItemInt>& items) { testing::upload(cable_, items, kFenceType); }
  /// The messages of this type that tern-mission has sent.
  template <class M>
  [[nodiscard]] std::vector<M> sent() const {
    std::vector<M> messages;
    for (const mavlink::Frame& frame : sent_) {
      if (const auto message = mavlink::from_frame<M>(frame)) messages.push_back(*message);
    }
    return messages;
  }
  /// The results of all uploads and clears of a type, in their order.
  [[nodiscard]] std::vector<int> results(std::uint8_t type) const {
    std::vector<int> results;
    for (const auto& ack : sent<mavlink::MissionAck>()) {
      if (ack.mission_type == type) results.push_back(ack.type);
    }
    return results;
  }
  /// All texts, one after the other.
  [[nodiscard]] std::string said() const {
    std::string said;
    for (const auto& text : sent<mavlink::StatusText>()) said += mavlink::string_of(text.text);
    return said;
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
  std::vector<std::vector<Fence>> heard_;  ///< FENCES
  bool takes_fences_ = false, maps_fences_ = true, has_folder_ = true, starts_on_upload_ = false;
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

/// It is flown for some seconds.
Mission slow_steps() {
  Mission mission = three_steps();
  for (Step& step : mission.steps) step.hold_s = 2.0;
  return mission;
}

/// A mission whose ground station uploads fences as well.
class FencedMission : public MissionNodeTest {
 protected:
  FencedMission() { takes_fences_ = true; }
  void expect_flown_once_fences_are_cleared() {
    send(mavlink::MissionClearAll{1, 1, kFenceType});
    run(1.0);
    order_start();
    run(5.0);
    EXPECT_EQ(flown_to_.size(), 3u);
  }
};

const std::vector<mavlink::MissionItemInt> kPond{fence_item(testing::kCircleExclusion, 0.5F, 6, 8)};
const std::vector<mavlink::MissionItemInt> kOnStepB{fence_item(testing::kCircleExclusion, 0.5F, 5, 4)};

TEST_F(FencedMission, UploadedFencesArePublishedAndAMissionBeginsOnceTheMapHoldsThem) {
  start();
  run(2.0);
  upload(three_steps());
  upload_fences(kPond);
  run(0.3);
  EXPECT_THAT(results(kFenceType), ::testing::ElementsAre(kAccepted));
  ASSERT_EQ(heard_.back().size(), 1u);
  EXPECT_FALSE(heard_.back()[0].is_inclusion);
  EXPECT_TRUE(std::get<FenceCircle>(heard_.back()[0].shape).centre.isApprox(Eigen::Vector2d(6, 8)));
  order_start();
  run(0.3);
  EXPECT_THAT(said(), ::testing::HasSubstr("the uploaded fences are not yet in force"));
  EXPECT_EQ(sent<mavlink::CommandAck>().back().result, 2);
  run(4.0);
  EXPECT_TRUE(flown_to_.empty());
  EXPECT_THAT(said(), ::testing::HasSubstr("1 uploaded fence is in force"));
  order_start();
  run(5.0);
  EXPECT_EQ(flown_to_.size(), 3u);
}

TEST_F(FencedMission, StartOnUploadWaitsForTheFencesThatFollow) {
  starts_on_upload_ = true;
  start();
  run(2.0);
  upload(three_steps());
  run(kUploadPause.seconds() - 0.5);
  upload_fences(kOnStepB);
  run(2.0 * kUploadPause.seconds());
  EXPECT_TRUE(flown_to_.empty()) << "refused fences keep it on the ground";
  EXPECT_THAT(said(), ::testing::HasSubstr("the mission does not start yet: "));
  upload_fences(kPond);
  run(kUploadPause.seconds() - 0.5);
  EXPECT_TRUE(flown_to_.empty());
  run(2.0 * kUploadPause.seconds() + 5.0);
  EXPECT_EQ(flown_to_.size(), 3u);
}

TEST_F(MissionNodeTest, StartOnUploadOutlivesARestartButNotAClear) {
  starts_on_upload_ = true;
  start();
  run(2.0);
  upload(three_steps());
  run(0.5);
  restart();
  run(kListen.seconds() + kUploadPause.seconds() + 5.0);
  EXPECT_EQ(flown_to_.size(), 3u);
  restart();
  run(2.0);
  upload(three_steps());
  run(0.5);
  send(mavlink::MissionClearAll{1, 1, kMissionType});
  run(2.0 * kUploadPause.seconds());
  EXPECT_TRUE(flown_to_.empty());
}

TEST_F(FencedMission, NoMissionBeginsWhileTheMapperDoesNotTakeTheFences) {
  maps_fences_ = false;
  start();
  run(2.0);
  upload(three_steps());
  upload_fences(kPond);
  run(15.0);
  EXPECT_THAT(said(), ::testing::HasSubstr("tern-mapper has not put them into its map"));
  EXPECT_EQ(node_->health().state, ProcessState::Waiting);
  order_start();
  run(3.0);
  EXPECT_TRUE(flown_to_.empty());
}

TEST_F(FencedMission, FencesOnAStepOrOnTheVehicleAreRefusedAndTheMissionCannotBegin) {
  start();
  run(2.0);
  upload(three_steps());
  upload_fences(kOnStepB);
  run(0.3);
  EXPECT_THAT(said(), ::testing::HasSubstr("waypoint 2 at (5.00, 4.00, 1.00) m is in uploaded fence"));
  upload_fences({fence_item(testing::kCircleExclusion, 0.5F, 1, 2)});
  run(0.3);
  EXPECT_THAT(said(), ::testing::HasSubstr("the vehicle at (1.00, 2.00, 1.00) m is in uploaded fence"));
  EXPECT_THAT(results(kFenceType), ::testing::ElementsAre(kInvalid, kInvalid));
  for (const auto& fences : heard_) EXPECT_TRUE(fences.empty());
  order_start();
  run(3.0);
  EXPECT_TRUE(flown_to_.empty());
  EXPECT_THAT(said(), ::testing::HasSubstr("the last upload of fences was refused: upload or clear fences"));
  expect_flown_once_fences_are_cleared();
}

TEST_F(FencedMission, AnUploadOfFencesThatBreaksOffKeepsTheMissionOnTheGround) {
  start();
  run(2.0);
  upload(three_steps());
  send(mavlink::MissionCount{2, 1, 1, kFenceType, 0});
  run(10.0);
  EXPECT_THAT(results(kFenceType), ::testing::ElementsAre(kCancelled));
  order_start();
  run(2.0);
  EXPECT_TRUE(flown_to_.empty());
  EXPECT_THAT(said(), ::testing::HasSubstr("the last upload of fences has not ended"));
}

TEST_F(FencedMission, StepsBeyondFencesInForceAreRefusedAtTheStart) {
  start();
  run(2.0);
  upload_fences(kOnStepB);
  run(5.0);
  upload(three_steps());
  run(0.3);
  EXPECT_THAT(results(kMissionType), ::testing::ElementsAre(kAccepted)) << "fences may be uploaded after it";
  order_start();
  run(3.0);
  EXPECT_TRUE(flown_to_.empty());
  EXPECT_THAT(said(), ::testing::HasSubstr("waypoint 2 at (5.00, 4.00, 1.00) m is in uploaded fence"));
  upload_fences(kPond);
  run(5.0);
  order_start();
  run(5.0);
  EXPECT_EQ(flown_to_.size(), 3u);
}

TEST_F(FencedMission, FencesStayAsTheyAreWhileAMissionIsFlown) {
  start();
  run(2.0);
  upload(slow_steps());
  upload_fences(kPond);
  run(5.0);
  order_start();
  run(0.5);
  ASSERT_FALSE(flown_to_.empty());
  upload_fences({});
  send(mavlink::MissionClearAll{1, 1, kFenceType});
  run(0.3);
  EXPECT_THAT(results(kFenceType), ::testing::ElementsAre(kAccepted, kInvalid, kDenied));
  EXPECT_THAT(said(), ::testing::HasSubstr("a mission is being flown"));
  run(10.0);
  EXPECT_EQ(flown_to_.size(), 3u);
  EXPECT_EQ(heard_.back().size(), 1u);
}

TEST_F(FencedMission, ARestartHasItsFencesAndReturnsThem) {
  start();
  run(2.0);
  upload_fences(kPond);
  run(3.0);
  heard_.clear();
  restart();
  run(4.0);
  ASSERT_FALSE(heard_.empty());
  EXPECT_EQ(heard_.front().size(), 1u) << "it never publishes that there is none";
  send(mavlink::MissionRequestInt{0, 1, 1, kFenceType});
  run(0.3);
  const auto items = sent<mavlink::MissionItemInt>();
  ASSERT_FALSE(items.empty());
  EXPECT_EQ(items.back().command, testing::kCircleExclusion);
  EXPECT_EQ(items.back().x, kPond[0].x);
  EXPECT_EQ(items.back().mission_type, kFenceType);
}

TEST_F(FencedMission, ARestartInFlightGoesOnInsideItsFences) {
  start();
  run(2.0);
  upload(slow_steps());
  upload_fences(kPond);
  run(5.0);
  order_start();
  run(0.5);
  ASSERT_FALSE(flown_to_.empty());
  const auto holds = [&] { return newest_->mode == GoalMode::Hold; };
  restart();
  for (int k = 0; k < 150; ++k) {
    run(0.1);
    EXPECT_FALSE(holds()) << k;
  }
  EXPECT_EQ(node_->health().state, ProcessState::Finished);
}

TEST_F(FencedMission, WithADamagedRecordNothingIsFlownUntilFencesAreUploadedOrCleared) {
  std::ofstream(folder_.file("fences.json")) << "[{\"command\": 5004}]";
  start();
  run(2.0);
  EXPECT_TRUE(heard_.empty()) << "the mapper keeps what it has";
  upload(three_steps());
  run(0.3);
  order_start();
  run(2.0);
  EXPECT_TRUE(flown_to_.empty());
  EXPECT_THAT(said(), ::testing::HasSubstr("the recorded fences are unreadable"));
  expect_flown_once_fences_are_cleared();
}

TEST_F(FencedMission, FencesThatARestartWouldLoseAreRefused) {
  has_folder_ = false;
  start();
  run(2.0);
  upload_fences(kPond);
  run(0.3);
  EXPECT_THAT(results(kFenceType), ::testing::ElementsAre(kInvalid));
  EXPECT_THAT(said(), ::testing::HasSubstr("--record FOLDER"));
}

TEST_F(FencedMission, WithoutFenceUploadsTheKeyIsNamed) {
  takes_fences_ = false;
  start();
  run(2.0);
  upload_fences(kPond);
  run(0.3);
  EXPECT_EQ(results(kFenceType).front(), kUnsupported);
  EXPECT_THAT(said(), ::testing::HasSubstr("set mission.fence_uploads in the scenario"));
  EXPECT_TRUE(heard_.empty());
}

TEST_F(FencedMission, FencesThatTheMapCannotHoldAreRefused) {
  start();
  run(2.0);
  upload_fences({fence_item(testing::kPolygonExclusion, 4, 3, 5), fence_item(testing::kPolygonExclusion, 4, 4, 6),
                 fence_item(testing::kPolygonExclusion, 4, 4, 5), fence_item(testing::kPolygonExclusion, 4, 3, 6)});
  run(0.3);
  EXPECT_THAT(said(), ::testing::HasSubstr("fence 1 is a polygon that touches or crosses itself"));
  map_ = support::free_map({40, 20, 12});
  restart();
  run(2.0);
  upload_fences(kPond);
  run(0.3);
  EXPECT_THAT(said(), ::testing::HasSubstr("the map ends within the fences"));
  EXPECT_THAT(results(kFenceType), ::testing::ElementsAre(kInvalid, kInvalid));
}

}  // namespace
}  // namespace tern::mission
