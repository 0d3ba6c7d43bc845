#include "planner/app/planner_node.h"

#include <gtest/gtest.h>

#include <thread>

#include "messages/batching.h"
#include "runtime/process.h"
#include "tests/planner/app/answers.h"
#include "tests/support/planner_worlds.h"
#include "tests/support/voxel_maps.h"

namespace tern {
namespace {

using namespace test_support;

constexpr UTime kStart{50'000'000};
const Vec3 kHome(0, 0, 1);

/// A planner node whose world, requests and time come from the test.
class PlannerNodeTest : public ::testing::Test {
 protected:
  void start(const PlannerExecution& execution, const PlannerConfig& config = {}) {
    UavSpec uav;
    uav.start = kHome;
    node_ = std::make_unique<PlannerNode>(bus_, uav, config, 42, execution);
  }

  void tell_world(std::vector<Track> tracks = {}) {
    TrackSet set;
    set.batch.set = ++sets_;
    set.made_at = clock_.now();
    set.tracks = std::move(tracks);
    for (const TrackSet& batch : split_batches(set)) answers_.bus().publish(channels::kPredictions, batch);
    for (const MapChunk& chunk : to_chunks(test_support::free_map({8, 8, 8})))
      answers_.bus().publish(channels::kSemanticMap, chunk);
    answers_.bus().publish(channels::kGoal, support::go_to(Vec3(6, 0, 1)));
    answers_.hear();
  }
  /// Until the map's fields and the goal's distances are ready.
  void prepare() {
    for (int k = 0; k < 100'000 && node_->health().state != ProcessState::Ready; ++k) {
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
  void at(UTime t) {
    clock_.advance_to(t);
    node_->step(t);
    answers_.hear();
  }
  /// Lets the worker come to its end.
  void until_heard(std::size_t plans) {
    for (int k = 0; k < 10'000'000 && answers_.plans.size() < plans; ++k) {
      answers_.hear();
      std::this_thread::yield();
    }
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
  EXPECT_EQ(bus_.counters().at(channels::kHorizonRequest).late, 1);
  EXPECT_EQ(bus_.counters().at(channels::kHorizonRequest).received, 1);
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

/// A wall of movers between home and goal, so that the search has much to look at.
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

TEST_F(PlannerNodeTest, ARequestHeardTwiceIsAnsweredOnce) {
  start({false, Duration{15'000}});
  tell_world();
  node_->step(clock_.now());
  HorizonRequest request =
      support::request_at(clock_.now() + Duration{75'000}, support::resting_at(kHome, kStart - Duration{1'000'000}));
  request.header.name = {5, 1};
  // As a network that duplicates packets delivers it: the same bytes twice.
  const Bytes bytes = encode(request);
  for (int k = 0; k < 2; ++k)
    lcm_->publish(channels::kHorizonRequest, bytes.data(), static_cast<unsigned>(bytes.size()));
  answers_.hear();
  at(kStart + Duration{15'000});
  at(kStart + Duration{75'000});
  EXPECT_EQ(answers_.plans.size(), 1u);
}

}  // namespace
}  // namespace tern
