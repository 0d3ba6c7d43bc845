// Log player and scene, with the node's own intake.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "flight_log/log_writer.h"
#include "messages/codec.h"
#include "tests/support/temp_folder.h"
#include "tests/viewer/known_log.h"
#include "tests/viewer/known_scene.h"
#include "viewer/bridge/app/listening_socket.h"
#include "viewer/bridge/app/log_player.h"
#include "viewer/bridge/page_goal.h"
#include "viewer/bridge/scene_json.h"

namespace tern {
namespace {

using nlohmann::json;
using support::kKnownLogStart;

/// One log for all tests of this file: writing it takes longer than playing it.
class LogPlayerTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TempFolder;
    support::write_known_log(folder_->file("flight.lcm"));
  }
  static void TearDownTestSuite() { delete folder_; }
  static std::string log() { return folder_->file("flight.lcm"); }
  static UTime at(double seconds) { return kKnownLogStart + Duration::from_seconds(seconds); }

  /// Returns everything that is shown, except the ages of processes.
  static std::string shown(const Scene& scene) {
    return state_json(scene) + truth_json(scene) + tracks_json(scene) + request_json(scene) + plan_json(scene, true) +
           timing_json(scene) + map_json(scene) + goal_json(scene) + hulls_json(scene, Duration{1'000'000}, 5.0, 100) +
           tracked_json(scene, {});
  }

  Scene scene_;
  SceneIntake intake_{scene_};
  static inline TempFolder* folder_ = nullptr;
};

TEST_F(LogPlayerTest, AJumpShowsWhatPlayingThereShows) {
  auto played = LogPlayer::open(log(), "");
  auto jumped = LogPlayer::open(log(), "");
  ASSERT_TRUE(played && jumped) << played.error().message;
  Scene there;
  SceneIntake there_intake(there);
  played->seek(played->begin(), scene_, intake_);
  played->play(true, UTime{0});
  for (int k = 1; k <= 40; ++k) {
    played->advance(UTime{k * 437'000}, intake_);
    jumped->seek(played->position(), there, there_intake);
    EXPECT_EQ(shown(there), shown(scene_)) << k;
  }
}

/// As in a flight, the next request is published before the answer to the last one.
TEST(LogPlayer, AJumpKnowsWhatAnAnswerWasGivenWhoseRequestIsNotTheNewest) {
  const TempFolder folder;
  const support::KnownScene known(kKnownLogStart);
  {
    auto writer = LogWriter::open(folder.file("flight.lcm"), 0);
    ASSERT_TRUE(writer);
    std::int64_t sequence = 0;
    const auto append = [&](const auto& channel, auto message, UTime now) {
      message.header = {{kKnownLogStart.us, ++sequence}, now};
      writer->append(channel.name, now.us, encode(message));
    };
    append(channels::kHorizonRequest, known.request(kKnownLogStart, 1), kKnownLogStart);
    append(channels::kHorizonRequest, known.request(kKnownLogStart + Duration{50'000}, 2),
           kKnownLogStart + Duration{50'000});
    append(channels::kPlanTiming, known.timing(1), kKnownLogStart + Duration{60'000});
  }
  auto player = LogPlayer::open(folder.file("flight.lcm"), "");
  ASSERT_TRUE(player) << player.error().message;
  Scene scene;
  SceneIntake intake(scene);
  player->seek(player->end(), scene, intake);
  ASSERT_TRUE(scene.timing());
  EXPECT_EQ(scene.request()->id, 2);
  EXPECT_DOUBLE_EQ(scene.allowed_ms(), 70.0);
}

TEST(LogPlayer, AJumpShowsTheNewestViewOfEachSensorAndWhatWasSeenInTheSecondBefore) {
  const TempFolder folder;
  const support::KnownScene known(kKnownLogStart);
  const auto at = [](int k) { return kKnownLogStart + Duration{k * 20'000}; };
  {
    auto writer = LogWriter::open(folder.file("flight.lcm"), 0);
    ASSERT_TRUE(writer);
    for (int k = 0; k < 200; ++k) {  // the second sensor sends every fifth time; both are blind at the end
      SightingSet set = known.sightings(at(k));
      if (k > 190) set.view.depths.assign(set.view.depths.size(), kBlindDepth);
      set.header = {{kKnownLogStart.us, k + 1}, at(k)};
      writer->append(channels::kObstacleSightings.name, at(k).us, encode(set));
      if (k % 5 != 0) continue;
      set.sensor_id = 1;
      writer->append(channels::kObstacleSightings.name, at(k).us, encode(set));
    }
  }
  auto player = LogPlayer::open(folder.file("flight.lcm"), "");
  ASSERT_TRUE(player) << player.error().message;
  Scene scene;
  SceneIntake intake(scene);
  player->seek(player->end(), scene, intake);
  ASSERT_EQ(scene.sightings().size(), 2U);
  EXPECT_EQ(scene.sightings().at(0).at, at(199));
  EXPECT_EQ(scene.sightings().at(1).at, at(195));
  const auto cells = [&](UTime since) {
    int count = 0;
    for (const auto& run : scene.seen().unseen(known.state(at(199)).motion.p, since)) count += run.count;
    return count;
  };
  EXPECT_LT(cells(at(150)), cells(at(191))) << "nothing is measured since, but before";
}

TEST_F(LogPlayerTest, GoesToAnyTimeInAnyOrder) {
  auto player = LogPlayer::open(log(), "");
  ASSERT_TRUE(player);
  EXPECT_EQ(player->begin(), at(0.0));
  EXPECT_EQ(player->end(), at(20.0));
  for (const double t : {15.0, 3.0, 19.99, 0.0, 7.77}) {
    player->seek(at(t), scene_, intake_);
    EXPECT_NEAR(scene_.state()->motion.p.x(), t, 0.0101) << t;
    EXPECT_EQ(scene_.truth()->obstacles.size(), 30U);
    EXPECT_EQ(scene_.map()->voxels[static_cast<std::size_t>(VoxelLabel::Repulsive)], 16);
  }
  player->seek(at(-5.0), scene_, intake_);
  EXPECT_EQ(player->position(), player->begin());
  player->seek(at(500.0), scene_, intake_);
  EXPECT_EQ(player->position(), player->end());
}

TEST_F(LogPlayerTest, StepsFromPlanToPlanAndStaysThere) {
  auto player = LogPlayer::open(log(), "");
  ASSERT_TRUE(player);
  player->seek(at(5.03), scene_, intake_);
  player->play(true, UTime{0});
  player->step(1, scene_, intake_);
  EXPECT_EQ(player->position(), at(5.1));
  EXPECT_FALSE(player->playing());
  player->step(-1, scene_, intake_);
  EXPECT_EQ(player->position(), at(5.0));
  player->seek(at(0.0), scene_, intake_);
  player->step(-1, scene_, intake_);
  EXPECT_EQ(player->position(), at(0.0));
}

TEST_F(LogPlayerTest, PlaysAtItsSpeedAndEndsAtTheEnd) {
  auto player = LogPlayer::open(log(), "");
  ASSERT_TRUE(player);
  player->seek(at(0.0), scene_, intake_);
  player->set_speed(0.5);
  player->play(true, UTime{0});
  player->advance(UTime{4'000'000}, intake_);
  EXPECT_EQ(player->position(), at(2.0));
  player->set_speed(8.0);
  player->advance(UTime{60'000'000}, intake_);
  EXPECT_EQ(player->position(), player->end());
  EXPECT_FALSE(player->playing());
}

TEST_F(LogPlayerTest, KnowsTheWholeFlightBeforeItPlays) {
  const auto player = LogPlayer::open(log(), "");
  ASSERT_TRUE(player);
  const FlightHistory& history = player->memory().history;
  const json chart = json::parse(
      history.chart_json(player->begin(), player->end(), {"PLAN_TIMING.total_ms", "PLAN_TIMING.allowed_ms"}));
  EXPECT_EQ(chart["end_s"], 20.0);
  EXPECT_EQ(chart["series"]["PLAN_TIMING.total_ms"][1].back(), 12.5);
  EXPECT_EQ(chart["series"]["PLAN_TIMING.allowed_ms"][1].back(), 70.0);
  EXPECT_EQ(chart["outcomes"][0].size(), 201U);
  EXPECT_EQ(chart["outcomes"][0].back(), 20.0);
  const auto events = player->memory().events.events();
  const auto is_goal = [](const FlightEvent& event) { return std::string(event.kind) == "goal"; };
  EXPECT_EQ(std::count_if(events.begin(), events.end(), is_goal), 1);
}

TEST_F(LogPlayerTest, ReadsPaceAndCauseFromTheSummaryBesideTheLog) {
  const TempFolder folder;
  std::filesystem::copy_file(log(), folder.file("flight.lcm"));
  std::ofstream(folder.file("summary.json")) << R"({"pace": 0.5, "why": "stood since 4.0 s"})";
  auto player = LogPlayer::open(folder.file("flight.lcm"), "");
  ASSERT_TRUE(player);
  EXPECT_EQ(player->note().why, "stood since 4.0 s");
  const json chart =
      json::parse(player->memory().history.chart_json(player->begin(), player->end(), {"PLAN_TIMING.allowed_ms"}));
  EXPECT_EQ(chart["series"]["PLAN_TIMING.allowed_ms"][1].back(), 140.0) << "by the clock of total_ms";
  for (const char* text :
       {"", "{", "[]", R"({"pace": 0, "why": 7})", R"({"pace": "1", "why": null})", R"({"pace": 2})"}) {
    std::ofstream(folder.file("summary.json")) << text;
    EXPECT_EQ(read_flight_note(folder.file("flight.lcm")).pace, 1.0) << text;
    EXPECT_EQ(read_flight_note(folder.file("flight.lcm")).why, "") << text;
  }
}

TEST_F(LogPlayerTest, PlaysADamagedLogAndSaysSo) {
  const std::string damaged = folder_->file("damaged.lcm");
  std::filesystem::copy_file(log(), damaged);
  const auto bytes = static_cast<std::streamoff>(std::filesystem::file_size(damaged));
  std::fstream file(damaged, std::ios::in | std::ios::out | std::ios::binary);
  for (const std::streamoff where : {bytes / 3, bytes / 2}) {
    file.seekp(where);
    file << std::string(20'000, '\xff');
  }
  file.close();
  std::filesystem::resize_file(damaged, static_cast<std::uintmax_t>(bytes - 100));
  auto player = LogPlayer::open(damaged, "");
  ASSERT_TRUE(player);
  const auto damage = json::parse(player->json())["damage"].get<std::string>();
  for (const char* part : {"could not be read", "messages are missing", "the end is cut off"}) {
    EXPECT_NE(damage.find(part), std::string::npos) << damage;
  }
  for (const double t : {2.0, 8.0, 12.0, 18.0}) {
    player->seek(at(t), scene_, intake_);
    EXPECT_NEAR(scene_.state()->motion.p.x(), t, 0.5) << t;
  }
}

TEST_F(LogPlayerTest, RefusesWhatIsNoLog) {
  EXPECT_FALSE(LogPlayer::open(folder_->file("nowhere.lcm"), ""));
  std::ofstream(folder_->file("text.lcm")) << "no events in here\n";
  const auto player = LogPlayer::open(folder_->file("text.lcm"), "");
  ASSERT_FALSE(player);
  EXPECT_NE(player.error().message.find("text.lcm"), std::string::npos);
}

/// A goal, and states of vehicles.
class PageGoalTest : public testing::Test {
 protected:
  static Goal goal(std::int64_t id) {
    Goal goal;
    goal.id = id;
    goal.header.utime = kKnownLogStart;
    return goal;
  }
  void hear_vehicle(std::int64_t epoch_us) {
    UavState state;
    state.header.name.sender_epoch_us = epoch_us;
    scene_.receive(state);
  }
  bool is_sent_at(double seconds) {
    return own_.due(scene_, kKnownLogStart + Duration::from_seconds(seconds)).has_value();
  }
  Scene scene_;
  PageGoal own_;
};

TEST_F(PageGoalTest, IsRepeatedUntilANewerOneIsHeard) {
  EXPECT_FALSE(is_sent_at(0.0));
  own_.set(goal(2), scene_, kKnownLogStart);
  EXPECT_TRUE(is_sent_at(0.0));
  EXPECT_FALSE(is_sent_at(0.9));
  EXPECT_TRUE(is_sent_at(1.0));
  hear_vehicle(5);  ///< the first vehicle that is received
  scene_.receive(goal(2));
  EXPECT_TRUE(is_sent_at(2.0));
  scene_.receive(goal(3));
  EXPECT_FALSE(is_sent_at(3.0));
  EXPECT_FALSE(is_sent_at(4.0));
}

TEST_F(PageGoalTest, IsNumberedAfterThoseThatWereSentAndThoseThatWereHeard) {
  hear_vehicle(5);
  EXPECT_EQ(own_.next_id(scene_), 1);
  own_.set(goal(1), scene_, kKnownLogStart);
  EXPECT_EQ(own_.next_id(scene_), 2) << "the bus has not told the first one yet";
  scene_.receive(goal(7));
  EXPECT_EQ(own_.next_id(scene_), 8);
}

TEST_F(PageGoalTest, IsNotSentToTheVehicleOfAnotherFlight) {
  hear_vehicle(5);
  own_.set(goal(2), scene_, kKnownLogStart);
  scene_.receive(goal(2));
  EXPECT_TRUE(is_sent_at(0.0));
  hear_vehicle(kKnownLogStart.us + 500'000);
  EXPECT_FALSE(is_sent_at(1.0));
  EXPECT_FALSE(is_sent_at(2.0));
  EXPECT_FALSE(scene_.goal());
  scene_.receive(goal(1));
  EXPECT_EQ(scene_.goal()->id, 1);
}

TEST(Scene, RemembersABoundedNumberOfProcesses) {
  Scene scene;
  for (int k = 0; k < 1'000; ++k) {
    Heartbeat heartbeat;
    heartbeat.process = "p" + std::to_string(k);
    scene.receive(heartbeat, kKnownLogStart);
  }
  EXPECT_EQ(scene.processes().size(), kMaxProcesses);
}

TEST(Scene, TellsAllMessagesOfWhatIsPicked) {
  Scene scene;
  const support::KnownScene known(kKnownLogStart);
  const HorizonRequest request = known.request(kKnownLogStart, 7);
  scene.receive(known.state(kKnownLogStart));
  scene.receive(known.truth(kKnownLogStart));
  scene.receive(known.predictions(kKnownLogStart));
  scene.receive(request);
  scene.receive(known.plan(request));
  scene.receive(known.timing(7));
  scene.receive(known.heartbeat(), kKnownLogStart);
  scene.receive(known.goal());
  scene.receive(known.map());
  const auto channels = [&](const PickCommand& pick) {
    std::vector<std::string> names;
    const json detail = json::parse(detail_json(scene, pick));
    for (const json& message : detail["messages"]) names.push_back(message["channel"]);
    return names;
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(channels({PickKind::Vehicle, 0, ""}), Names{"UAV_STATE"});
  EXPECT_EQ(channels({PickKind::Obstacle, 25, ""}), (Names{"OBSTACLE_TRUTH", "PREDICTIONS"}));
  EXPECT_EQ(channels({PickKind::Obstacle, 99, ""}), Names{});
  EXPECT_EQ(channels({PickKind::Plan, 0, ""}), (Names{"PLAN", "PLAN_TIMING"}));
  EXPECT_EQ(channels({PickKind::Request, 0, ""}), Names{"HORIZON_REQUEST"});
  EXPECT_EQ(channels({PickKind::Goal, 0, ""}), Names{"GOAL"});
  EXPECT_EQ(channels({PickKind::Map, 0, ""}), Names{"SEMANTIC_MAP"});
  EXPECT_EQ(channels({PickKind::Process, 0, "tern-scene"}), Names{"HEARTBEAT"});
  EXPECT_EQ(channels({PickKind::Result, 0, ""}), Names{});
}

TEST(ListeningSocket, TakesTheAddressThatItIsGiven) {
  const auto any = open_listening_socket("127.0.0.1:0", false);
  ASSERT_TRUE(any) << any.error().message;
  const std::string url = *listening_url(*any);
  EXPECT_TRUE(url.starts_with("http://127.0.0.1:")) << url;
  EXPECT_EQ(host_of_url(url), "127.0.0.1");
  EXPECT_FALSE(is_ipv6_socket(*any));
  const std::string taken = url.substr(7, url.size() - 8);
  EXPECT_FALSE(open_listening_socket(taken, false));
  for (const char* where : {"", "nowhere", "127.0.0.1:", "127.0.0.1:70000", "127.0.0.1:x", "::1", "256.0.0.1:80"}) {
    EXPECT_FALSE(open_listening_socket(where, false)) << where;
  }
  EXPECT_FALSE(listening_url(0));
  close(*any);
}

}  // namespace
}  // namespace tern
