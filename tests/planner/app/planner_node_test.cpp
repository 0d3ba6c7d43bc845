#include "planner/app/planner_node.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "messages/batching.h"
#include "runtime/process.h"
#include "tests/planner/app/answers.h"
#include "tests/support/planner_worlds.h"
#include "tests/support/voxel_maps.h"

namespace tern {
namespace {

using namespace support;

constexpr UTime kStart{50'000'000};
/// Goals on opposite sides of home, so that a plan shows which of them it is for.
const Vec3 kHome(0, 0, 1), kEast(6, 0, 1), kWest(-6, 0, 1);

/// A planner node whose world, requests and time come from the test.
class PlannerNodeTest : public ::testing::Test {
 protected:
  void start(const PlannerExecution& execution, const PlannerConfig& config = {}) {
    UavSpec uav;
    uav.start = kHome;
    node_ = std::make_unique<PlannerNode>(bus_, uav, config, 42, execution);
  }

  void tell_predictions(std::vector<Track> tracks = {}) {
    TrackSet set;
    set.batch.set = ++sets_;
    set.made_at = clock_.now();
    set.tracks = std::move(tracks);
    for (const TrackSet& batch : split_batches(set)) answers_.bus().publish(channels::kPredictions, batch);
    answers_.hear();
  }
  void tell_map(const VoxelMap& map) {
    for (const MapChunk& chunk : to_chunks(map)) answers_.bus().publish(channels::kSemanticMap, chunk);
    answers_.hear();
  }
  /// @return the name that the message got.
  MessageName tell_goal(std::int64_t id, const Vec3& position, GoalMode mode = GoalMode::Go) {
    Goal goal;
    goal.id = id;
    goal.position = position;
    goal.mode = mode;
    const MessageName name = answers_.bus().publish(channels::kGoal, goal);
    answers_.hear();
    return name;
  }
  /// Sends a goal to hold, as viewer pages do.
  MessageName tell_hold(std::int64_t id) { return tell_goal(id, Vec3::Zero(), GoalMode::Hold); }
  void tell_world(std::vector<Track> tracks = {}) {
    tell_predictions(std::move(tracks));
    tell_map(support::free_map({8, 8, 8}));
    tell_goal(1, kEast);
  }
  /// Waits until the map's fields and the goal's distances are ready.
  void prepare() {
    for (const auto end = patience(); std::chrono::steady_clock::now() < end;) {
      if (node_->health().state == ProcessState::Ready) break;
      node_->step(clock_.now());
      std::this_thread::yield();
    }
    ASSERT_EQ(node_->health().state, ProcessState::Ready) << node_->health().waiting_for;
  }
  HorizonRequest ask(std::int64_t id) {
    HorizonRequest request =
        support::request_at(clock_.now() + Duration{75'000}, support::resting_at(kHome, kStart - Duration{1'000'000}));
    request.id = id;
    answers_.bus().publish(channels::kHorizonRequest, request);
    answers_.hear();
    return request;
  }
  /// Delivers a request under a given name; its id is its sequence number.
  void deliver(const MessageName& name, UTime deadline) {
    HorizonRequest request =
        support::request_at(deadline + Duration{5'000}, support::resting_at(kHome, kStart - Duration{1'000'000}));
    request.id = name.sequence;
    request.header.name = name;
    const Bytes bytes = encode(request);
    lcm_->publish(channels::kHorizonRequest.name, bytes.data(), static_cast<unsigned>(bytes.size()));
    answers_.hear();
  }
  /// In virtual time: returns the answer to the vehicle that started at `epoch_us`.
  Plan answer_to(std::int64_t epoch_us, std::int64_t sequence) {
    deliver({epoch_us, sequence}, clock_.now() + Duration{70'000});
    at(clock_.now() + Duration{15'000});
    EXPECT_FALSE(answers_.plans.empty());
    return answers_.plans.empty() ? Plan() : answers_.plans.back();
  }
  void at(UTime t) {
    clock_.advance_to(t);
    node_->step(t);
    answers_.hear();
  }
  /// Waits until the worker is idle. It may have answered and still be busy; the next request then waits for a step.
  void until_heard(std::size_t plans) {
    for (const auto end = patience(); answers_.plans.size() < plans && std::chrono::steady_clock::now() < end;) {
      node_->step(clock_.now());
      answers_.hear();
      std::this_thread::yield();
    }
  }

  /// Waits for a job that takes milliseconds if the machine gives the worker a core.
  static std::chrono::steady_clock::time_point patience() {
    return std::chrono::steady_clock::now() + std::chrono::seconds(180);
  }

  SharedClock clock_{kStart};
  std::shared_ptr<lcm::LCM> lcm_ = std::make_shared<lcm::LCM>("memq://");
  Bus bus_{lcm_, clock_, 1};
  Answers answers_{lcm_, clock_};
  std::int64_t sets_ = 0;
  std::unique_ptr<PlannerNode> node_;
};

TEST_F(PlannerNodeTest, SaysWhatItWaitsForUntilItHasAWorld) {
  start({false, Duration{15'000}});
  EXPECT_EQ(node_->health().state, ProcessState::Waiting);
  EXPECT_EQ(node_->health().waiting_for, "predictions");
  tell_world();
  node_->step(clock_.now());
  EXPECT_EQ(node_->health().state, ProcessState::Ready);
}

TEST_F(PlannerNodeTest, WithoutAWorldItStillAnswersAndSaysWhy) {
  start({false, Duration{15'000}});
  (void)ask(1);
  at(kStart + Duration{15'000});
  ASSERT_EQ(answers_.plans.size(), 1u);
  EXPECT_EQ(answers_.plans[0].outcome, PlanOutcome::NoPlan);
  EXPECT_EQ(answers_.plans[0].reason, PlanReason::StaleWorld);
}

TEST_F(PlannerNodeTest, InVirtualTimeTheAnswerComesAfterItsLatency) {
  start({false, Duration{15'000}});
  tell_world();
  node_->step(clock_.now());
  (void)ask(1);
  at(kStart + Duration{14'999});
  EXPECT_TRUE(answers_.plans.empty());
  at(kStart + Duration{15'000});
  ASSERT_EQ(answers_.plans.size(), 1u);
  EXPECT_EQ(answers_.plans[0].outcome, PlanOutcome::Optimized);
  EXPECT_EQ(answers_.plans[0].inputs.configuration_hash, 42u);
  ASSERT_EQ(answers_.timings.size(), 1u);
  EXPECT_EQ(answers_.timings[0].request_id, 1);
}

TEST_F(PlannerNodeTest, ALateRequestIsCountedAndNotAnswered) {
  start({false, Duration{15'000}});
  tell_world();
  HorizonRequest late =
      support::request_at(clock_.now() + Duration{5'000}, support::resting_at(kHome, kStart - Duration{1'000'000}));
  late.id = 9;
  answers_.bus().publish(channels::kHorizonRequest, late);
  answers_.hear();
  at(kStart + Duration{100'000});
  EXPECT_TRUE(answers_.plans.empty());
  EXPECT_EQ(bus_.counters().at(channels::kHorizonRequest.name).late, 1);
  EXPECT_EQ(bus_.counters().at(channels::kHorizonRequest.name).received, 1);
}

/// A search that never ends by itself within the test: only the clock can end it.
PlannerConfig endless() {
  PlannerConfig config;
  config.search.max_expansions = 10'000'000;
  config.search.hold_expansions = 10'000'000;
  config.search.band_m = 0.001;
  config.search.samples_xy = config.search.samples_z = 15;
  config.search.prune_position_m = 0.01;
  return config;
}

/// A wall of movers between home and goal, so that the search is long.
std::vector<Track> crowd() {
  std::vector<Track> tracks;
  Rng rng(3);
  for (int id = 1; id <= 40; ++id) {
    tracks.push_back(
        support::random_mover(rng, id, Box(Vec3(1.8, -2.5, -1), Vec3(4.5, 2.5, 3)), kStart - Duration{100'000}, 5.0));
  }
  return tracks;
}

TEST_F(PlannerNodeTest, ASlowWorkerIsAnsweredForByTheWatchdogBeforeTheDeadlineAndOnlyOnce) {
  start({true, Duration{}}, endless());
  tell_world(crowd());
  prepare();
  tell_world(crowd());
  for (std::int64_t id = 1; id <= 3; ++id) {
    const HorizonRequest request = ask(id);
    const auto before = static_cast<std::size_t>(id - 1);
    ASSERT_EQ(answers_.plans.size(), before);
    at(request.deadline - kWatchdogLead);
    ASSERT_EQ(answers_.plans.size(), before + 1) << "request " << id;
    EXPECT_EQ(answers_.plans.back().request_id, id);
    EXPECT_EQ(answers_.timings.size(), answers_.plans.size());
    at(request.deadline);
    at(request.deadline + Duration{20'000});
  }
  node_.reset();  // the worker comes to its end
  answers_.hear();
  for (const auto& [id, times] : answers_.per_request()) EXPECT_EQ(times, 1) << "request " << id;
  EXPECT_EQ(answers_.plans.size(), 3u);
}

TEST_F(PlannerNodeTest, AWorkerInTimeIsItsOwnAnswer) {
  start({true, Duration{}});
  tell_world();
  prepare();
  tell_world();
  (void)ask(1);
  until_heard(1);
  ASSERT_EQ(answers_.plans.size(), 1u);
  EXPECT_EQ(answers_.plans[0].outcome, PlanOutcome::Optimized);
  EXPECT_FALSE(answers_.timings.at(0).from_watchdog);
  at(kStart + Duration{500'000});
  EXPECT_EQ(answers_.plans.size(), 1u);
}

TEST_F(PlannerNodeTest, AnUnfinishedRequestIsAnsweredWhenTheNextOneComes) {
  start({true, Duration{}}, endless());
  tell_world(crowd());
  prepare();
  tell_world(crowd());
  (void)ask(1);
  (void)ask(2);
  answers_.hear();
  ASSERT_EQ(answers_.plans.size(), 1u);
  EXPECT_EQ(answers_.plans[0].request_id, 1);
  at(kStart + Duration{75'000});
  node_.reset();
  answers_.hear();
  const auto count = answers_.per_request();
  EXPECT_EQ(count.at(1), 1);
  EXPECT_EQ(count.at(2), 1);
}

TEST_F(PlannerNodeTest, ABusyMachineIsNoStuckWorker) {
  start({true, Duration{}}, endless());
  tell_world(crowd());
  prepare();
  tell_world(crowd());
  // The request was long on its way: 6 ms are left. Two deadlines after its arrival the worker may still be busy.
  deliver({5, 1}, clock_.now() + Duration{6'000});
  at(clock_.now() + Duration{12'000});
  EXPECT_FALSE(node_->finished());
  EXPECT_EQ(answers_.plans.size(), 1u);
}

TEST_F(PlannerNodeTest, ARequestThatTheWatchdogAnsweredWhileItWaitedIsNotPlanned) {
  PlannerConfig config = endless();
  config.publish_search = true;
  std::vector<std::int64_t> searched;
  answers_.bus().subscribe(channels::kSearchView, [&](const SearchView& view) { searched.push_back(view.request_id); });
  start({true, Duration{}}, config);
  tell_world(crowd());
  prepare();
  tell_world(crowd());
  (void)ask(1);
  const HorizonRequest second = ask(2);
  at(second.deadline);
  for (const auto end = patience(); node_->busy() && std::chrono::steady_clock::now() < end;) std::this_thread::yield();
  ASSERT_FALSE(node_->busy());
  at(clock_.now() + Duration{20});  // the worker is free: it would take the second now
  node_.reset();                    // waits for what the worker is at
  answers_.hear();
  EXPECT_EQ(searched, std::vector<std::int64_t>{1});
  EXPECT_EQ(answers_.per_request().at(2), 1);
}

TEST_F(PlannerNodeTest, ARequestHeardTwiceIsAnsweredOnce) {
  start({false, Duration{15'000}});
  tell_world();
  node_->step(clock_.now());
  // A network may duplicate packets: the same bytes arrive twice.
  for (int k = 0; k < 2; ++k) deliver({5, 1}, kStart + Duration{70'000});
  at(kStart + Duration{15'000});
  at(kStart + Duration{75'000});
  EXPECT_EQ(answers_.plans.size(), 1u);
}

TEST_F(PlannerNodeTest, ALateCopyOfAnOlderRequestDoesNotCloseTheNewest) {
  start({false, Duration{15'000}});
  tell_world();
  node_->step(clock_.now());
  for (const std::int64_t sequence : {1, 2, 1}) deliver({5, sequence}, kStart + Duration{70'000});
  at(kStart + Duration{15'000});
  at(kStart + Duration{30'000});
  const auto count = answers_.per_request();
  EXPECT_EQ(count.at(1), 1);
  EXPECT_EQ(count.at(2), 1);
  EXPECT_EQ(answers_.plans.back().request_id, 2);
  EXPECT_EQ(answers_.plans.back().outcome, PlanOutcome::Optimized);
}

TEST_F(PlannerNodeTest, AHoldCountsAtTheNextRequestThoughAMapIsBeingMade) {
  start({true, Duration{}});
  tell_world();
  prepare();
  tell_map(support::free_map({100, 100, 40}));
  tell_predictions();
  node_->step(clock_.now());
  const MessageName hold = tell_hold(2);
  (void)ask(1);
  until_heard(1);
  ASSERT_EQ(answers_.plans.size(), 1u);
  EXPECT_EQ(answers_.plans[0].inputs.goal, hold);
  EXPECT_EQ(answers_.plans[0].outcome, PlanOutcome::KeepCommitted);
  EXPECT_EQ(answers_.plans[0].reason, PlanReason::AtGoal);
}

TEST_F(PlannerNodeTest, AWayThatIsBeingMadeWhenAHoldComesDoesNotUndoIt) {
  start({true, Duration{}});
  tell_world();
  prepare();
  tell_goal(2, kWest);
  node_->step(clock_.now());  // the way west is being made
  const MessageName hold = tell_hold(3);
  const VoxelMap next = support::free_map({9, 8, 8});
  tell_map(next);
  // The worker prepares one product at a time: first the distance field, then the map.
  std::int64_t id = 0;
  do {
    tell_predictions();
    (void)ask(++id);
    until_heard(static_cast<std::size_t>(id));
    ASSERT_EQ(answers_.plans.size(), static_cast<std::size_t>(id));
    ASSERT_EQ(answers_.plans.back().inputs.goal, hold);
    node_->step(clock_.now());
  } while (answers_.plans.back().inputs.map_version != next.version);
}

TEST_F(PlannerNodeTest, AfterAHoldItFliesOn) {
  start({false, Duration{15'000}});
  tell_world();
  node_->step(clock_.now());
  tell_hold(2);
  tell_goal(3, kEast);
  node_->step(clock_.now());
  const Plan plan = answer_to(5, 1);
  EXPECT_EQ(plan.outcome, PlanOutcome::Optimized);
  EXPECT_GT(plan.local_goal.x(), 1.0);
}

TEST_F(PlannerNodeTest, APlanNamesTheNewestRepetitionOfItsGoal) {
  // A logger that joins late has not received the first goal; without the second its log could not be replayed.
  start({false, Duration{15'000}});
  tell_world();
  node_->step(clock_.now());
  const MessageName first = answer_to(5, 1).inputs.goal;
  tell_goal(1, kEast);
  node_->step(clock_.now());
  const MessageName second = answer_to(5, 2).inputs.goal;
  EXPECT_EQ(second.sequence, first.sequence + 1);
  tell_hold(2);
  const MessageName hold = answer_to(5, 3).inputs.goal;
  tell_hold(2);
  EXPECT_EQ(answer_to(5, 4).inputs.goal.sequence, hold.sequence + 1);
}

TEST_F(PlannerNodeTest, AHoldNeedsNoWay) {
  start({false, Duration{15'000}});
  tell_hold(2);
  tell_world();  // its goal has a smaller id
  node_->step(clock_.now());
  EXPECT_EQ(node_->health().state, ProcessState::Ready);
  EXPECT_EQ(answer_to(5, 1).reason, PlanReason::AtGoal);
}

/// A second flight while the planner keeps running: the first vehicle started at 5 µs.
class SecondFlight : public PlannerNodeTest {
 protected:
  void fly_the_first(std::vector<Track> tracks = {}) {
    start({false, Duration{15'000}});
    tell_world(std::move(tracks));
    tell_goal(7, kEast);
    node_->step(clock_.now());
    first_ = answer_to(5, 1);
    clock_.advance_to(clock_.now() + Duration{1'000'000});
    epoch_us_ = clock_.now().us;
    clock_.advance_to(clock_.now() + Duration{1'000});
    tell_predictions();
  }
  void expect_west(const Plan& plan) {
    EXPECT_EQ(plan.outcome, PlanOutcome::Optimized);
    EXPECT_LT(plan.local_goal.x(), -1.0);
  }
  Plan first_;
  std::int64_t epoch_us_ = 0;
};

TEST_F(SecondFlight, DoesNotInheritTheGoal) {
  fly_the_first();
  EXPECT_EQ(answer_to(epoch_us_, 1).reason, PlanReason::StaleWorld);
  EXPECT_EQ(node_->health().waiting_for, "a goal");
  tell_goal(1, kWest);
  node_->step(clock_.now());
  expect_west(answer_to(epoch_us_, 2));
}

TEST_F(SecondFlight, KeepsItsOwnGoalThoughThatCameBeforeItsFirstRequest) {
  fly_the_first();
  tell_goal(1, kWest);
  deliver({epoch_us_, 1}, clock_.now() + Duration{70'000});
  node_->step(clock_.now());
  (void)answer_to(epoch_us_, 2);
  at(clock_.now() + Duration{15'000});
  expect_west(answers_.plans.back());
}

TEST_F(SecondFlight, DoesNotGoAroundTheFirstOnesObstacles) {
  fly_the_first({support::standing_box(4, Box(Vec3(2, -3, -3), Vec3(3, 3, 5)), kStart)});
  tell_goal(7, kEast);
  (void)answer_to(epoch_us_, 1);
  const GoalFieldInputs from = answer_to(epoch_us_, 2).inputs.goal_field;
  EXPECT_NE(first_.inputs.goal_field.statics, digest_of({}));
  EXPECT_EQ(from.statics, digest_of({}));
  EXPECT_EQ(from.statics_first_set, sets_);  // from there on a replay remembers, too
}

}  // namespace
}  // namespace tern
