// Processes end and restart during a flight.
#include <gtest/gtest.h>

#include "campaign/virtual_system.h"
#include "executor/app/executor_node.h"
#include "messages/channels.h"
#include "simulator/app/simulator_node.h"
#include "tests/support/watched_flight.h"

namespace tern::testing {
namespace {

/// Longer than the rest of any committed trajectory, and than any input stays fresh.
constexpr double kLongEnough = 2.5;

/// Obstacles before and after the middle of the corridor, so that a vehicle at rest there without planner is not hit.
constexpr char kObstacles[] =
    "world.obstacles=["
    "{motion: trefoil, centre: [8, 0.5, 1], slowness: 1.1}, {centre: [14, -1, 2], half_extents: [0.2, 0.2, 4]},"
    "{motion: trefoil, centre: [48, 0, 1], slowness: 1.1}, {centre: [54, 0, 2], half_extents: [0.2, 0.2, 4]},"
    "{motion: trefoil, centre: [62, -0.5, 2], slowness: 1.1, phase: 2}]";

class Restarts : public ::testing::Test {
 protected:
  Restarts()
      : system_(scenario_file("paper_corridor"),
                {"world.generator=none", "world.count=0", kObstacles, "executor.rate_hz=10"}) {
    Bus& bus = system_.runner().observer();
    bus.subscribe(channels::kHorizonRequest, [this](const HorizonRequest& r) { exchange_.on_request(r); });
    bus.subscribe(channels::kPlan, [this](const Plan& plan) { exchange_.on_plan(plan); });
    system_.runner().run(now() + Duration::from_seconds(20.0), [this] { return simulator().world_zero().has_value(); });
  }

  [[nodiscard]] UTime now() { return system_.runner().now(); }
  [[nodiscard]] const SimulatorNode& simulator() { return system_.simulator(); }
  [[nodiscard]] const Executor& executor() { return *system_.executor().executor(); }
  void fly(double seconds) { system_.runner().run(now() + Duration::from_seconds(seconds)); }
  void fly_to_the_end() {
    system_.runner().run(now() + Duration::from_seconds(100.0), [this] { return simulator().result().has_value(); });
    ASSERT_TRUE(simulator().result().has_value());
    expect_reached(*simulator().result());
  }
  /// Flies to the middle of the corridor, at speed.
  void fly_midway() {
    fly(4.3);
    ASSERT_GT(executor().sample(now()).v.norm(), 1.0);
  }
  void expect_at_rest_at(const Vec3& p) {
    EXPECT_TRUE(executor().at_rest(now()));
    EXPECT_LT((executor().sample(now()).p - p).norm(), 1e-9);
    EXPECT_LT(executor().sample(now()).v.norm(), 1e-9);
  }
  [[nodiscard]] Vec3 committed_end() { return executor().sample(executor().committed().end()).p; }
  /// Returns the answers to requests from `from` on.
  [[nodiscard]] std::vector<Plan> answers_since(UTime from) {
    std::vector<Plan> answers;
    for (const Plan& plan : exchange_.plans) {
      if (exchange_.requests.at(plan.request_id).header.utime >= from) answers.push_back(plan);
    }
    return answers;
  }
  void expect_stale(const std::vector<Plan>& answers) {
    EXPECT_GT(answers.size(), 10U);
    for (const Plan& plan : answers) {
      EXPECT_EQ(plan.outcome, PlanOutcome::NoPlan);
      EXPECT_EQ(plan.reason, PlanReason::StaleWorld);
    }
  }

  VirtualSystem system_;
  Exchange exchange_;
};

TEST_F(Restarts, WithoutPredictionsTheVehicleComesToRestUntilTheyAreBack) {
  fly_midway();
  system_.stop("tern-predictor");
  fly(0.5);
  const UTime stale_from = now();
  const Vec3 end = committed_end();
  fly(kLongEnough);
  expect_stale(answers_since(stale_from));
  expect_at_rest_at(end);
  system_.start("tern-predictor");
  fly_to_the_end();
  expect_answered_once_and_in_time(executor().counters(), exchange_);
}

TEST_F(Restarts, WithoutAPlannerTheVehicleComesToRestUntilItIsBack) {
  fly_midway();
  system_.stop("tern-planner");
  const Vec3 end = committed_end();
  fly(kLongEnough);
  expect_at_rest_at(end);
  const std::int64_t unanswered = executor().counters().unanswered;
  EXPECT_GT(unanswered, 10);
  system_.start("tern-planner");
  fly_to_the_end();
  const ExecutorCounters& counters = executor().counters();
  EXPECT_LE(counters.unanswered, unanswered + 1);
  EXPECT_EQ(counters.late(), 0);
  EXPECT_EQ(counters.answered_twice(), 0);
  EXPECT_LE(counters.requests - counters.answered_in_time - counters.unanswered, 1);
}

TEST_F(Restarts, WithoutAnExecutorTheVehicleFliesWhatWasCommittedToItsEnd) {
  fly_midway();
  const Vec3 end = committed_end();
  const std::size_t requests = exchange_.requests.size();
  system_.stop("tern-executor");
  fly(kLongEnough);
  const MotionHistory& truth = simulator().vehicle().truth();
  EXPECT_LT((truth.sample(truth.end()).p - end).norm(), 1e-9);
  EXPECT_EQ(exchange_.requests.size(), requests);
  exchange_ = Exchange();
  system_.start("tern-executor");
  fly_to_the_end();
  EXPECT_EQ(simulator().result()->stops, 1);
  expect_answered_once_and_in_time(executor().counters(), exchange_);
}

TEST_F(Restarts, AnExecutorThatIsBackAtOnceWaitsForTheVehicleToRest) {
  fly_midway();
  const Vec3 end = committed_end();
  system_.stop("tern-executor");
  system_.start("tern-executor");
  while (system_.executor().executor() == nullptr) fly(0.01);
  EXPECT_LT((executor().sample(executor().committed().end()).p - end).norm(), 0.05);
  fly_to_the_end();
}

TEST_F(Restarts, APlannerThatHasTheMapDoesNotMissTheMapper) {
  fly_midway();
  system_.stop("tern-mapper");
  const UTime from = now();
  fly(kLongEnough);
  for (const Plan& plan : answers_since(from)) EXPECT_NE(plan.reason, PlanReason::StaleWorld);
  system_.start("tern-mapper");
  fly_to_the_end();
  EXPECT_EQ(simulator().result()->stops, 0);
  expect_answered_once_and_in_time(executor().counters(), exchange_);
}

TEST_F(Restarts, APlannerThatComesBackWithoutAMapperWaitsForAMap) {
  fly_midway();
  system_.stop("tern-mapper");
  system_.stop("tern-planner");
  const Vec3 end = committed_end();
  system_.start("tern-planner");
  const UTime from = now();
  fly(kLongEnough);
  expect_stale(answers_since(from));
  expect_at_rest_at(end);
  system_.start("tern-mapper");
  fly_to_the_end();
}

TEST(LateProcess, APlannerThatJoinsLateHasTheMapAndFlies) {
  VirtualSystem system(scenario_file("paper_corridor"),
                       {"world.generator=none", "world.count=0", kObstacles, "executor.rate_hz=10"});
  VirtualRunner& runner = system.runner();
  system.stop("tern-planner");
  runner.run(runner.now() + Duration::from_seconds(5.0));
  EXPECT_FALSE(system.simulator().world_zero()) << "the flight began without a planner";
  system.start("tern-planner");
  runner.run(runner.now() + Duration::from_seconds(120.0), [&] { return system.simulator().result().has_value(); });
  ASSERT_TRUE(system.simulator().result());
  expect_reached(*system.simulator().result());
}

}  // namespace
}  // namespace tern::testing
