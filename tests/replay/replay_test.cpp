#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <optional>
#include <set>

#include "core/base/digest.h"
#include "executor/app/executor_node.h"
#include "flight_log/log_writer.h"
#include "flight_log/text_log.h"
#include "messages/codec.h"
#include "runtime/config.h"
#include "runtime/scenario_file.h"
#include "simulator/app/simulator_node.h"
#include "simulator/vehicle/perfect_vehicle.h"
#include "simulator/worlds/world.h"
#include "tests/replay/golden_flights.h"
#include "tests/support/fixture.h"
#include "tests/support/recorded_flight.h"
#include "tests/support/temp_folder.h"
#include "tools/replay/extract.h"
#include "tools/replay/replan.h"
#include "tools/replay/replay_report.h"

namespace tern::testing {
namespace {

/// One flight on virtual time in which predictor and planner die and come back, recorded whole (tests/flights).
class ReplayTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { folder_ = new TempFolder; }
  static void TearDownTestSuite() {
    delete folder_;
    folder_ = nullptr;
  }
  static std::string log() { return recorded_log("restarts"); }

  /// The log again, without the events for which `change` returns false, the others as it left them.
  static std::string rewritten(const std::function<bool(LogEvent&)>& change) {
    const std::string path = folder_->file("rewritten.lcm");
    std::filesystem::remove(path);
    auto reader = LogReader::open(log());
    auto writer = LogWriter::open(path, 0);
    while (auto event = reader->next()) {
      if (change(*event)) writer->append(event->channel, event->received_us, event->data);
    }
    return path;
  }

  static Replay replay(const std::string& path, const ReplayOptions& options = {}) {
    auto result = replay_log(path, options);
    EXPECT_TRUE(result) << result.error().message;
    return std::move(*result);
  }

  static bool text_has(const Replay& replay, const std::string& words) {
    return replay_text(replay, false).find(words) != std::string::npos;
  }

  static TempFolder* folder_;
};
TempFolder* ReplayTest::folder_ = nullptr;

TEST_F(ReplayTest, OfAFlightWithRestartsGivesTheSameBytes) {
  const Replay all = replay(log());
  EXPECT_GT(all.plans.size(), 60U);
  EXPECT_EQ(all.count(Agreement::Identical), static_cast<std::int64_t>(all.plans.size())) << replay_text(all, false);
  EXPECT_EQ(replay_exit_code(all, false), 0);
  EXPECT_TRUE(text_has(all, "the same bytes"));
}

/// A page tells the vehicle to hold, and later to fly on.
void tell_goal(VirtualSystem& system, std::int64_t id, GoalMode mode, const Vec3& position) {
  Goal goal;
  goal.id = id;
  goal.mode = mode;
  goal.position = position;
  system.runner().observer().publish(channels::kGoal, goal);
}

/// Another simulator and executor, with another world and goal, beside the same predictor, mapper and planner.
void fly_again(VirtualSystem& system) {
  static const Scenario scenario = [] {
    auto document = ConfigDocument::load(
        std::string(TERN_SCENARIO_FOLDER) + "/closing_in.yaml",
        {"world.obstacles=[{name: wall, centre: [-3, 0.2, 2], half_extents: [0.3, 2, 2]}]", "uav.goal=[-8, 0, 2]"});
    return read_scenario(document);
  }();
  for (const char* process : {"tern-simulator", "tern-executor"}) system.runner().stop(process);
  system.runner().start("tern-simulator", [](Bus& bus) {
    return std::make_unique<SimulatorNode>(bus, scenario, make_world(scenario, "").value(),
                                           std::make_unique<PerfectVehicle>(scenario.uav, bus.clock().now()),
                                           SimulatorConfig());
  });
  system.runner().start("tern-executor",
                        [](Bus& bus) { return std::make_unique<ExecutorNode>(bus, scenario.uav, ExecutorConfig()); });
}

TEST_F(ReplayTest, OfHoldingAndOfASecondFlightGivesTheSameBytes) {
  const std::string path = folder_->file("two_flights.lcm");
  record_virtually(
      {std::string(TERN_SCENARIO_FOLDER) + "/closing_in.yaml",
       {"world.obstacles=[{name: post, centre: [3, 0.2, 2], half_extents: [0.3, 0.3, 2]}]", "uav.goal=[8, 0, 2]"},
       6.0,
       {{1.5, [](VirtualSystem& system) { tell_goal(system, 2, GoalMode::Hold, Vec3::Zero()); }},
        {3.0, [](VirtualSystem& system) { tell_goal(system, 3, GoalMode::Go, Vec3(8, 0, 2)); }},
        {4.0, fly_again}}},
      path);
  const Replay all = replay(path);
  EXPECT_EQ(all.count(Agreement::Identical), static_cast<std::int64_t>(all.plans.size())) << replay_text(all, false);
  std::map<std::uint64_t, int> statics;
  std::map<GoalMode, int> modes;
  for (const RecordedPlan& recorded : all.inputs.plans) {
    const PlanInputs& names = recorded.plan.inputs;
    if (names.goal != MessageName{}) ++modes[all.inputs.goals.at(names.goal).mode];
    if (recorded.plan.outcome == PlanOutcome::Optimized) ++statics[names.goal_field.statics];
  }
  EXPECT_GT(modes[GoalMode::Hold], 10);
  EXPECT_EQ(statics.size(), 2U) << "one world each, none of both";
  EXPECT_LT(all.inputs.plans.back().plan.trajectory.control_points(0, 7), -1.0) << "the second goal";
}

TEST_F(ReplayTest, OfAVehicleWhoseTubeChangesGivesTheSameBytes) {
  const std::string path = folder_->file("tube.lcm");
  record_virtually({std::string(TERN_SCENARIO_FOLDER) + "/closing_in.yaml",
                    {"world.obstacles=[{name: post, centre: [4, 0.2, 2], half_extents: [0.3, 0.3, 2]}]",
                     "uav.goal=[8, 0, 2]", "simulator.vehicle=quadrotor", "simulator.wind.speed=6",
                     "simulator.wind.burst=15", "simulator.wind.burst_at_s=2"},
                    6.0,
                    {}},
                   path);
  const Replay all = replay(path);
  std::set<double> tubes;
  for (const auto& [name, request] : all.inputs.requests) tubes.insert(request.tube.y());
  EXPECT_GT(tubes.size(), 1U);
  EXPECT_EQ(all.count(Agreement::Identical), static_cast<std::int64_t>(all.plans.size())) << replay_text(all, false);
}

/// Water full of lilies, whose label promises nothing to a camera.
TEST_F(ReplayTest, OfDensitiesThatWereLearntInFlightGivesTheSameBytes) {
  const std::string path = folder_->file("lilies.lcm"), kept = folder_->file("lilies_extract.lcm");
  record_virtually(
      {std::string(TERN_SCENARIO_FOLDER) + "/lake.yaml",
       {"simulator.estimation=vio", "planner.semantics.error_price=20", "planner.semantics.learn_densities=true",
        "simulator.vio.landmarks.regions.water=4", "uav.goal=[40, 0, 1]"},
       7.0,
       {}},
      path);
  const Replay all = replay(path);
  EXPECT_EQ(all.count(Agreement::Identical), static_cast<std::int64_t>(all.plans.size())) << replay_text(all, false);
  const auto by_densities = std::ranges::count_if(all.inputs.plans, [&](const RecordedPlan& recorded) {
    return all.inputs.densities.contains(recorded.plan.inputs.goal_field.statics);
  });
  EXPECT_GT(by_densities, 10);
  EXPECT_LT(by_densities, std::ssize(all.inputs.plans)) << "first by the labels";
  EXPECT_GT(all.inputs.log.channels.at(channels::kLandmarkDensities.name).messages, std::ssize(all.inputs.densities))
      << "repeated for a logger that starts late";
  ASSERT_TRUE(write_extract(path, {}, kept, ""));
  const Replay extracted = replay(kept);
  EXPECT_EQ(extracted.count(Agreement::Identical), static_cast<std::int64_t>(all.plans.size()));
  copy_log_with<LandmarkDensities>(path, folder_->file("lilies_lost.lcm"), channels::kLandmarkDensities.name,
                                   [](LandmarkDensities&) { return false; });
  const Replay lost = replay(folder_->file("lilies_lost.lcm"));
  EXPECT_EQ(lost.missing(), by_densities);
  EXPECT_TRUE(text_has(lost, "or the LANDMARK_DENSITIES of that name"));
}

TEST_F(ReplayTest, AnAnswerThatIsNotThePlannersIsFoundWithItsStage) {
  int count = 0;
  const std::string path = rewritten([&](LogEvent& event) {
    if (event.channel != channels::kPlan.name) return true;
    Plan plan = *decode<Plan>(event.data);
    if (plan.outcome != PlanOutcome::Optimized || ++count != 5) return true;
    plan.trajectory.control_points(0, 4) += 1e-5;
    event.data = encode(plan);
    return true;
  });
  const Replay found = replay(path);
  EXPECT_EQ(found.unfulfilled(), 1);
  EXPECT_EQ(replay_exit_code(found, false), 1);
  EXPECT_TRUE(text_has(found, "first in the stage \"optimization\"")) << replay_text(found, false);
  EXPECT_TRUE(text_has(found, "control point 4"));
}

TEST_F(ReplayTest, AnswersThatAreNotTheSameBytesButAgreeKeepTheWeakerPromiseOnly) {
  const auto changed = [&](std::uint64_t build) {
    return replay(rewritten([&](LogEvent& event) {
      if (event.channel != channels::kPlan.name) return true;
      Plan plan = *decode<Plan>(event.data);
      plan.trajectory.control_points(0, 4) += 1e-9;
      plan.inputs.planner_build += build;
      event.data = encode(plan);
      return true;
    }));
  };
  EXPECT_EQ(replay_exit_code(changed(0), false), 1);
  const Replay elsewhere = changed(1);
  EXPECT_EQ(replay_exit_code(elsewhere, false), 0) << replay_text(elsewhere, false);
  EXPECT_EQ(elsewhere.count(Agreement::Identical), 0);
  EXPECT_TRUE(text_has(elsewhere, "the planner's build differs"));
}

TEST_F(ReplayTest, SaysWhatTheLogLacksAndReplaysTheRest) {
  // A map and a goal are repeated: only without all of them are they missing.
  const std::map<std::string, int> kept{{channels::kHorizonRequest.name, 4},
                                        {channels::kPredictions.name, 4},
                                        {channels::kGoal.name, 1'000},
                                        {channels::kSemanticMap.name, 1'000}};
  for (const auto& [channel, every] : kept) {
    int count = 0;
    const Replay rest = replay(rewritten(
        [&, name = channel, n = every](LogEvent& event) { return event.channel != name || ++count % n == 0; }));
    EXPECT_GT(rest.missing(), 0) << channel;
    EXPECT_EQ(rest.unfulfilled(), 0) << channel << "\n" << replay_text(rest, false);
    EXPECT_EQ(replay_exit_code(rest, false), 3) << channel;
    EXPECT_TRUE(text_has(rest, "not in the log: ")) << channel;
  }
}

TEST_F(ReplayTest, OfALogThatBeginsLaterSaysHowManyAnswersCameBefore) {
  int count = 0;
  const Replay rest =
      replay(rewritten([&](LogEvent& event) { return event.channel != channels::kPlan.name || ++count > 3; }));
  EXPECT_EQ(rest.missing(), 0);
  EXPECT_EQ(rest.unfulfilled(), 0);
  EXPECT_TRUE(text_has(rest, "PLAN: 3 answers were published before")) << replay_text(rest, false);
  EXPECT_EQ(replay_exit_code(rest, false), 3);
}

TEST_F(ReplayTest, WithoutItsConfigurationNothingIsReplayedButTheLogIsRead) {
  const Replay rest = replay(rewritten([](LogEvent& event) { return event.channel != channels::kConfiguration.name; }));
  EXPECT_EQ(rest.missing(), static_cast<std::int64_t>(rest.plans.size()));
  EXPECT_TRUE(text_has(rest, "not in the log: configuration ")) << replay_text(rest, false);
}

TEST_F(ReplayTest, AConfigurationThatThisVersionCannotReadIsMissingAndNoDifference) {
  std::map<std::uint64_t, std::uint64_t> hashes;
  const Replay rest = replay(rewritten([&](LogEvent& event) {
    if (event.channel == channels::kConfiguration.name) {
      auto report = *decode<ConfigurationReport>(event.data);
      report.yaml += "planner: [a, form, of, another, version]\n";
      hashes[report.hash] = digest(report.yaml);
      report.hash = digest(report.yaml);
      event.data = encode(report);
    }
    if (event.channel == channels::kPlan.name) {
      auto plan = *decode<Plan>(event.data);
      plan.inputs.configuration_hash = hashes.at(plan.inputs.configuration_hash);
      event.data = encode(plan);
    }
    return true;
  }));
  EXPECT_EQ(rest.missing(), static_cast<std::int64_t>(rest.plans.size()));
  EXPECT_EQ(rest.count(Agreement::Different), 0);
  EXPECT_EQ(replay_exit_code(rest, false), 3);
  EXPECT_TRUE(text_has(rest, "in a form that this version reads (")) << replay_text(rest, false);
}

/// Two executors asked the same planner, each with an id of 1.
TEST_F(ReplayTest, ARestartedExecutorsAnswersKeepTheirOwnTimingsAndHeadings) {
  const TempFolder folder;
  {
    auto writer = LogWriter::open(folder.file("two.lcm"), 0);
    const auto put = [&](const char* channel, auto message, std::int64_t number) {
      message.header = {{9, number}, UTime{1'000 + number}};
      message.request_id = 1;
      writer->append(channel, 1'000 + number, encode(message));
    };
    for (const std::int64_t executor : {1, 2}) {
      const MessageName asked{executor, 1};
      Plan plan;
      plan.outcome = PlanOutcome::NoPlan;
      plan.inputs.request = asked;
      put(channels::kPlan.name, plan, executor);
      PlanTiming timing;
      timing.total_ms = static_cast<double>(executor);
      put(channels::kPlanTiming.name, timing, executor);
      PlanHeading heading;
      heading.request = asked;
      heading.control_points.assign(8, static_cast<double>(executor));
      put(channels::kPlanHeading.name, heading, executor);
    }
  }
  const auto inputs = read_recorded_inputs(folder.file("two.lcm"));
  ASSERT_TRUE(inputs);
  ASSERT_EQ(inputs->plans.size(), 2U);
  for (const RecordedPlan& recorded : inputs->plans) {
    const auto executor = static_cast<double>(recorded.plan.inputs.request.sender_epoch_us);
    ASSERT_TRUE(recorded.timing && recorded.heading);
    EXPECT_EQ(recorded.timing->total_ms, executor);
    EXPECT_EQ(recorded.heading->control_points[0], executor);
  }
}

TEST_F(ReplayTest, OfALogWithoutOneOfItsPartsIsIncomplete) {
  const TempFolder folder;
  auto reader = LogReader::open(log());
  {
    auto writer = LogWriter::open(folder.file("flight.lcm"), 200'000);
    for (int k = 0; auto event = reader->next(); ++k) {
      writer->append(event->channel, event->received_us, event->data);
      if (k % 100 == 0) (void)writer->flush();
    }
  }
  std::filesystem::remove(folder.file("flight.001.lcm"));
  const Replay rest = replay(folder.file("flight.lcm"));
  EXPECT_EQ(rest.unfulfilled(), 0);
  EXPECT_EQ(replay_exit_code(rest, false), 3);
  EXPECT_TRUE(text_has(rest, "its part flight.001.lcm is missing")) << replay_text(rest, false);
}

TEST_F(ReplayTest, OfALogWhoseNameIsNotUtf8IsToldAsJson) {
  Replay rest = replay(log());
  rest.inputs.log.parts = {"flight\xff.lcm"};
  EXPECT_NE(replay_json(rest, false).find("flight\uFFFD.lcm"), std::string::npos);
}

TEST_F(ReplayTest, ATruncatedOrDamagedLogIsReplayedAsFarAsItGoes) {
  const std::string path = rewritten([](LogEvent&) { return true; });
  std::filesystem::resize_file(path, std::filesystem::file_size(path) * 2 / 3);
  const Replay rest = replay(path);
  EXPECT_EQ(rest.unfulfilled(), 0);
  EXPECT_GT(rest.count(Agreement::Identical), 30);
  EXPECT_EQ(replay_exit_code(rest, false), 3);
  EXPECT_TRUE(text_has(rest, "its end is cut off")) << replay_text(rest, false);
}

TEST_F(ReplayTest, MessagesOfAnotherVersionAreCountedAndForeignChannelsPassedOver) {
  int count = 0;
  const Replay rest = replay(rewritten([&](LogEvent& event) {
    if (event.channel == channels::kUavState.name) event.channel = "CAMERA";
    if (event.channel == channels::kPlan.name && ++count % 2 == 0) event.data[0] ^= 1U;
    return true;
  }));
  EXPECT_EQ(rest.unfulfilled(), 0);
  EXPECT_EQ(replay_exit_code(rest, false), 3);
  EXPECT_TRUE(text_has(rest, "of another version")) << replay_text(rest, false);
  EXPECT_TRUE(text_has(rest, "CAMERA"));
}

TEST_F(ReplayTest, ASmallLogOfSomeAnswersReplaysThem) {
  ReplayOptions options;
  options.from_s = 3.0;
  const auto some = extract(log(), options, 3);
  ASSERT_TRUE(some) << some.error().message;
  const TempFolder folder;
  ASSERT_TRUE(write_log(*some, folder.file("small.lcm")));
  EXPECT_FALSE(write_log(*some, folder.file("small.lcm"))) << "nothing is overwritten";
  const Replay small = replay(folder.file("small.lcm"));
  EXPECT_GT(small.plans.size(), 10U);
  EXPECT_EQ(small.count(Agreement::Identical), static_cast<std::int64_t>(some->inputs.plans.size()));
  EXPECT_EQ(replay_exit_code(small, false), 0) << replay_text(small, false);
  EXPECT_LT(std::filesystem::file_size(folder.file("small.lcm")), std::filesystem::file_size(log()) / 2);
}

TEST_F(ReplayTest, AFixtureGivesAUnitTestTheRequestItsWorldAndTheAnswer) {
  ReplayOptions options;
  options.request = 40;
  const auto one = extract(log(), options);
  ASSERT_TRUE(one) << one.error().message;
  const TempFolder folder;
  ASSERT_TRUE(write_fixture(*one, folder.file("request_40.txt")));
  const auto fixture = load_fixture(folder.file("request_40.txt"));
  ASSERT_TRUE(fixture) << fixture.error().message;
  EXPECT_EQ(fixture->problem.request.id, 40);
  EXPECT_FALSE(fixture->problem.world.predictions->set.tracks.empty());
  EXPECT_EQ(encode(replan(fixture->problem, fixture->answer).plan), encode(fixture->answer));
  EXPECT_EQ(replay_exit_code(replay(folder.file("request_40.txt")), false), 0);
}

TEST_F(ReplayTest, AFixtureThatWasSpoiledSaysWhere) {
  const TempFolder folder;
  std::ofstream(folder.file("bad.txt")) << kTextLogHead << "\n# words\nGOAL 1 0g\n";
  const auto fixture = load_fixture(folder.file("bad.txt"));
  ASSERT_FALSE(fixture);
  EXPECT_NE(fixture.error().message.find("bad.txt:3"), std::string::npos) << fixture.error().message;
}

TEST_F(ReplayTest, OtherSettingsSayWhatTheyChange) {
  ReplayOptions options;
  options.other.settings = {"planner.sphere_radius_m=2.5"};
  const Replay what_if = replay(log(), options);
  EXPECT_GT(what_if.count(Agreement::Different), 0);
  EXPECT_EQ(replay_exit_code(what_if, true), 0);
  EXPECT_NE(replay_text(what_if, true).find("other trajectories"), std::string::npos);
}

TEST_F(ReplayTest, RefusesSettingsThatCannotTakeEffect) {
  for (const char* setting : {"uav.limits.v_max=4", "semantics.regions=[]", "semantics={}", "seed=3", "plannerx.a=1",
                              "predictor.confidence=0.9"}) {
    ReplayOptions options;
    options.other.settings = {"planner.hold_required_s=1", setting};
    EXPECT_THROW((void)replay_log(log(), options), ConfigError) << setting;
  }
  for (const char* setting : {"planner.bogus=1", "planner.hold_required_s=-1"}) {
    ReplayOptions options;
    options.other.settings = {setting};
    EXPECT_THROW((void)replay_log(log(), options), ConfigError) << setting;
  }
  for (const char* setting :
       {"semantics.lambda_attractive=3", "semantics.lambdas.texture=1", "semantics.cost=exposure"}) {
    EXPECT_NO_THROW((OtherSettings{"", {setting}}.check())) << setting;
  }
}

TEST_F(ReplayTest, RefusesAChoiceOfNoAnswer) {
  ReplayOptions options;
  options.request = 100'000;
  const auto none = replay_log(log(), options);
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().message.find("no answer is selected"), std::string::npos) << none.error().message;
  options.request.reset();
  options.from_s = 3.0;
  options.to_s = 2.0;
  EXPECT_FALSE(replay_log(log(), options));
}

TEST_F(ReplayTest, RefusesAFileWithoutAWholeEvent) {
  const std::string path = folder_->file("no_log.lcm");
  for (const std::string& bytes : {std::string(), std::string(10'000, '?')}) {
    std::ofstream(path, std::ios::trunc) << bytes;
    const auto none = replay_log(path, {});
    ASSERT_FALSE(none) << bytes.size() << " bytes";
    EXPECT_EQ(none.error().message, path + ": holds no complete message");
  }
}

/// Solves the problems of the log again.
class ReplanTest : public ReplayTest {
 protected:
  /// Calls `use` with the problem of each answer that had a world.
  static void for_each_problem(const std::function<void(const PlanProblem&, const Plan&)>& use) {
    const auto all = extract(log(), {}, 4);
    WorldRebuilder rebuilder(all->inputs, {});
    for (const TrackSet& set : all->predictions) {
      rebuilder.add(set);
      for (const RecordedPlan& recorded : all->inputs.plans) {
        if (recorded.plan.inputs.prediction_set != set.batch.set) continue;
        const auto problem = rebuilder.problem_of(recorded.plan);
        if (problem && problem->world.goal) use(*problem, recorded.plan);
      }
    }
  }
};

TEST_F(ReplanTest, ABudgetThatEndsAnywhereIsReplayedByItsCounts) {
  int cut = 0;
  for_each_problem([&](const PlanProblem& problem, const Plan& recorded) {
    for (const std::int64_t turns : {0, 1, 7, 60}) {
      Budget budget([turns](const BudgetCut& here) { return here.count >= turns; });
      Plan live = plan(problem.request, problem.world, problem.config, budget).plan;
      live.header = recorded.header;
      cut += live.cuts.empty() ? 0 : 1;
      EXPECT_EQ(encode(replan(problem, live).plan), encode(live)) << "after " << turns;
    }
  });
  EXPECT_GT(cut, 20);
}

/// Stores every improvement.
struct Answers final : PlanObserver {
  void enter(Stage) override {}
  void answer(const Plan& best_so_far) override { all.push_back(best_so_far); }
  std::vector<Plan> all;
};

TEST_F(ReplanTest, TheWatchdogsAnswerIsTheImprovementThatItSent) {
  int several = 0;
  for_each_problem([&](const PlanProblem& problem, const Plan& recorded) {
    Answers answers;
    Budget budget = Budget::unlimited();
    plan(problem.request, problem.world, problem.config, budget, &answers);
    several += answers.all.size() > 1 ? 1 : 0;
    for (std::size_t k = 0; k < answers.all.size(); ++k) {
      Plan sent = answers.all[k];
      sent.header = recorded.header;
      sent.standing = static_cast<std::int64_t>(k) + 1;
      EXPECT_EQ(encode(replan(problem, sent).plan), encode(sent));
    }
  });
  EXPECT_GT(several, 5);
}

}  // namespace
}  // namespace tern::testing
