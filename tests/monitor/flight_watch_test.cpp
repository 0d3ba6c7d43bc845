#include "monitor/flight_watch.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tern {
namespace {

constexpr UTime kStart{1'000'000'000};

Heartbeat simulator(std::int64_t epoch) {
  Heartbeat heartbeat;
  heartbeat.process = kSimulatorProcess;
  heartbeat.header.name = {epoch, 1};
  heartbeat.state = ProcessState::Ready;
  return heartbeat;
}

constexpr std::int64_t kExecutorEpoch = 77;

Heartbeat executor() {
  Heartbeat heartbeat;
  heartbeat.process = kExecutorProcess;
  heartbeat.header.name = {kExecutorEpoch, 1};
  heartbeat.state = ProcessState::Ready;
  return heartbeat;
}

HorizonRequest request() {
  HorizonRequest request;
  request.header = {{kExecutorEpoch, 1}, kStart};
  request.id = 1;
  request.deadline = kStart + Duration{50'000};
  return request;
}

UavState state(const Vec3& p, const Vec3& v, UTime at) {
  UavState state;
  state.header.utime = state.at = at;
  state.motion.p = p;
  state.motion.v = v;
  return state;
}

Scenario scenario() {
  Scenario scenario;
  scenario.name = "test";
  scenario.seed = 7;
  scenario.world.count = 100;
  scenario.uav.start = Vec3(0, 0, 1);
  scenario.uav.goal = Vec3(10, 0, 1);
  scenario.uav.body.radius = 0.5;
  scenario.timeout_s = 30.0;
  return scenario;
}

FlightResult verdict_of(std::int64_t simulator_epoch, FlightOutcome outcome) {
  FlightResult result;
  result.header = {{simulator_epoch, 1}, kStart};
  result.outcome = outcome;
  return result;
}

TEST(FlightWatch, TakesTheRefereesOutcomeAfterTheLastWords) {
  for (const FlightOutcome outcome :
       {FlightOutcome::Reached, FlightOutcome::Collision, FlightOutcome::Timeout, FlightOutcome::Failed}) {
    FlightWatch watch(scenario(), kStart);
    watch.receive(simulator(1), kStart);
    FlightResult result = verdict_of(1, outcome);
    result.detail = "why";
    watch.receive(result, kStart + Duration{1'000});
    EXPECT_FALSE(watch.ending(kStart + Duration{1'000}));
    const auto ending = watch.ending(kStart + Duration{1'000} + kLastReports);
    ASSERT_TRUE(ending);
    EXPECT_EQ(ending->outcome, outcome);
    EXPECT_EQ(ending->detail, "why");
  }
}

TEST(FlightWatch, FailsWhenTheSimulatorIsNotHeard) {
  FlightWatch watch(scenario(), kStart);
  EXPECT_FALSE(watch.ending(kStart + kSimulatorSilence));
  EXPECT_EQ(watch.ending(kStart + kSimulatorSilence + Duration{1})->outcome, FlightOutcome::Failed);
  const UTime heard = kStart + Duration{10'000'000};
  watch.receive(simulator(1), heard);
  EXPECT_FALSE(watch.ending(heard + kSimulatorSilence));
  EXPECT_TRUE(watch.ending(heard + kSimulatorSilence + Duration{1}));
}

TEST(FlightWatch, FailsWhenTheWorldIsLostMidway) {
  FlightWatch watch(scenario(), kStart);
  watch.receive(simulator(1), kStart);
  watch.receive(executor(), kStart);
  watch.receive(request(), kStart);
  EXPECT_FALSE(watch.ending(kStart));
  UTime now = kStart;
  for (int k = 0; k < 5; ++k) watch.receive(simulator(2), now = now + Duration{500'000});
  EXPECT_FALSE(watch.ending(now)) << "the first may still be heard";
  watch.receive(simulator(2), now = now + Duration{500'000});
  const auto ending = watch.ending(now);
  ASSERT_TRUE(ending);
  EXPECT_EQ(ending->outcome, FlightOutcome::Failed);
  EXPECT_NE(ending->detail.find("world is lost"), std::string::npos);
}

TEST(FlightWatch, ASecondSimulatorBesideTheFirstEndsNothing) {
  FlightWatch watch(scenario(), kStart);
  watch.receive(simulator(5), kStart);
  watch.receive(executor(), kStart);
  watch.receive(request(), kStart);
  UTime now = kStart;
  for (int k = 0; k < 20; ++k) {
    now = now + Duration{500'000};
    watch.receive(simulator(5), now);
    watch.receive(simulator(9), now);
    watch.receive(simulator(2), now);
    EXPECT_FALSE(watch.ending(now));
  }
  EXPECT_EQ(watch.live().concurrent, "3 tern-simulator");
  EXPECT_EQ(watch.summary({}).restarts, 0);
}

TEST(FlightWatch, TheVerdictIsThatOfTheSimulatorThatTheFlightBeganWith) {
  FlightWatch watch(scenario(), kStart);
  watch.receive(verdict_of(1, FlightOutcome::Reached), kStart);
  EXPECT_FALSE(watch.ending(kStart + kLastReports)) << "there is no simulator yet";
  watch.receive(simulator(5), kStart);
  watch.receive(executor(), kStart);
  watch.receive(request(), kStart);
  watch.receive(verdict_of(9, FlightOutcome::Reached), kStart);
  EXPECT_FALSE(watch.ending(kStart + kLastReports));
  watch.receive(verdict_of(5, FlightOutcome::Timeout), kStart);
  EXPECT_EQ(watch.ending(kStart + kLastReports)->outcome, FlightOutcome::Timeout);
}

TEST(FlightWatch, AVerdictIsDroppedWhenTheSimulatorFliesOn) {
  FlightWatch watch(scenario(), kStart);
  watch.receive(simulator(5), kStart);
  watch.receive(executor(), kStart);
  watch.receive(request(), kStart);
  watch.receive(verdict_of(5, FlightOutcome::Reached), kStart);
  Heartbeat next = simulator(5);
  next.header.utime = kStart + Duration{400'000};
  watch.receive(next, next.header.utime);
  EXPECT_FALSE(watch.ending(kStart + kLastReports));
}

TEST(FlightWatch, ASimulatorThatStartsAnewBeforeTheFlightIsARestartOnly) {
  FlightWatch watch(scenario(), kStart);
  UTime now = kStart;
  for (const std::int64_t epoch : {1, 1, 2, 2, 2, 2, 2}) watch.receive(simulator(epoch), now = now + Duration{500'000});
  watch.receive(executor(), now);
  watch.receive(request(), now);
  EXPECT_FALSE(watch.ending(now));
  EXPECT_EQ(watch.summary({}).restarts, 1);
}

TEST(FlightWatch, FailsWhenTheRefereeKeepsSilent) {
  FlightWatch watch(scenario(), kStart);
  watch.receive(executor(), kStart);
  watch.receive(request(), kStart);
  const UTime late = kStart + Duration{30'000'000} + kResultSlack;
  watch.receive(simulator(1), late);
  EXPECT_FALSE(watch.ending(late));
  EXPECT_TRUE(watch.ending(late + Duration{1}));
}

TEST(FlightWatch, FailsForTheLaunchersFirstReason) {
  FlightWatch watch(scenario(), kStart);
  watch.fail("first");
  watch.fail("second");
  EXPECT_EQ(watch.ending(kStart)->detail, "first");
}

TEST(FlightWatch, AVerdictCountsMoreThanAFailureAfterIt) {
  FlightWatch watch(scenario(), kStart);
  watch.receive(simulator(1), kStart);
  watch.receive(verdict_of(1, FlightOutcome::Reached), kStart);
  watch.fail("a process ended");
  EXPECT_EQ(watch.ending(kStart + kLastReports)->outcome, FlightOutcome::Reached);
}

TEST(FlightWatch, ShowsProgressSpeedAndTheNearestObstacle) {
  FlightWatch watch(scenario(), kStart);
  EXPECT_FALSE(watch.live().flying);
  watch.receive(executor(), kStart);
  watch.receive(request(), kStart);
  watch.receive(state(Vec3(4, 0, 1), Vec3(3, 4, 0), kStart + Duration{2'000'000}));
  EXPECT_TRUE(std::isnan(watch.live().nearest_m));
  TrueObstacle near, far;
  near.position = Vec3(4, 3, 1);
  near.half_extents = Vec3::Constant(0.5);
  far.position = Vec3(40, 0, 1);
  watch.receive({far, near});
  const LiveView view = watch.live();
  EXPECT_TRUE(view.flying);
  EXPECT_DOUBLE_EQ(view.elapsed_s, 2.0);
  EXPECT_NEAR(view.progress, 0.4, 1e-12);
  EXPECT_DOUBLE_EQ(view.speed_mps, 5.0);
  EXPECT_NEAR(view.nearest_m, 2.0, 1e-12);  // 3 m less the obstacle's half and the body's radius
}

TEST(FlightWatch, ShowsTheNearestWallOfTheMapBesideTheObstacles) {
  FlightWatch watch(scenario(), kStart);
  watch.receive(executor(), kStart);
  watch.receive(request(), kStart);
  watch.receive(state(Vec3(4, 0, 1), Vec3::Zero(), kStart + Duration{2'000'000}));
  EXPECT_TRUE(std::isnan(watch.live().nearest_wall_m));
  watch.receive_map({Box(Vec3(6, -1, 0), Vec3(7, 1, 2)), Box(Vec3(4, 8, 0), Vec3(5, 9, 2))});
  EXPECT_NEAR(watch.live().nearest_wall_m, 1.5, 1e-12);
  EXPECT_TRUE(std::isnan(watch.live().nearest_m));
}

TEST(FlightWatch, MeasuresWhatHangsBelowFromWhereItHangs) {
  Scenario hanging = scenario();
  hanging.uav.body.radius = 0.0;
  hanging.uav.body.vertices = Points(3, 2);
  hanging.uav.body.vertices << 0, 0, 0, 0, 0.1, -1.0;
  FlightWatch watch(hanging, kStart);
  watch.receive(executor(), kStart);
  watch.receive(request(), kStart);
  watch.receive(state(Vec3(0, 0, 3), Vec3::Zero(), kStart + Duration{2'000'000}));
  TrueObstacle above;
  above.position = Vec3(0, 0, 4);
  above.half_extents = Vec3::Constant(0.5);
  watch.receive(std::vector{above});
  EXPECT_NEAR(watch.live().nearest_m, 0.4, 1e-12);
}

TEST(FlightWatch, MeasuresProgressToANewGoal) {
  FlightWatch watch(scenario(), kStart);
  watch.receive(executor(), kStart);
  watch.receive(request(), kStart);
  watch.receive(state(Vec3(0, 5, 1), Vec3::Zero(), kStart));
  Goal goal;
  goal.id = 2;
  goal.position = Vec3(0, 20, 1);
  watch.receive(goal);
  EXPECT_NEAR(watch.live().progress, 0.25, 1e-12);
}

TEST(FlightWatch, WhereTheGoalIsTheStartAllOfTheWayIsDone) {
  FlightWatch watch(scenario(), kStart);
  watch.receive(executor(), kStart);
  watch.receive(request(), kStart);
  watch.receive(state(Vec3(1, 0, 0), Vec3::Zero(), kStart));
  Goal goal;
  goal.id = 2;
  goal.position = scenario().uav.start;
  watch.receive(goal);
  EXPECT_EQ(watch.live().progress, 1.0);
}

TEST(FlightWatch, SumsUpTimesOfTheStagesThatRan) {
  FlightWatch watch(scenario(), kStart);
  for (int i = 1; i <= 100; ++i) {
    PlanTiming timing;
    timing.total_ms = i;
    timing.stage_ms[static_cast<int>(Stage::Search)] = i <= 50 ? 0.0 : 2.0 * i;
    watch.receive(timing);
  }
  const ReplanTimes times = watch.summary({}).replan_ms;
  EXPECT_EQ(times.total.p99, 99.0);
  EXPECT_EQ(times.search.p50, 150.0);
  EXPECT_TRUE(std::isnan(times.first_answer.p50));
  EXPECT_TRUE(std::isnan(times.hulls.max));
}

TEST(FlightWatch, RanksTheTimesOfAnAnswerThatWasDeliveredTwiceOnce) {
  FlightWatch watch(scenario(), kStart);
  for (int i = 1; i <= 4; ++i) {
    PlanTiming timing;
    timing.header.name = {9, i};
    timing.total_ms = i;
    for (int copy = 0; copy < (i == 4 ? 9 : 1); ++copy) watch.receive(timing);
  }
  EXPECT_EQ(watch.summary({}).replan_ms.total.p50, 2.0);
}

TEST(FlightWatch, SummaryNamesTheScenario) {
  const FlightSummary summary = FlightWatch(scenario(), kStart).summary({FlightOutcome::Failed, "why"});
  EXPECT_EQ(summary.scenario, "test");
  EXPECT_EQ(summary.seed, 7U);
  EXPECT_EQ(summary.count, 100);
  EXPECT_EQ(summary.detail, "why");
  EXPECT_FALSE(summary.result);
}

Heartbeat logger(double seconds, ProcessState state = ProcessState::Ready, const std::string& says = "") {
  Heartbeat heartbeat;
  heartbeat.process = kLoggerProcess;
  heartbeat.header = {{99, 1}, kStart + Duration::from_seconds(seconds)};
  heartbeat.state = state;
  heartbeat.waiting_for = says;
  return heartbeat;
}

TEST(FlightWatch, ARecordingIsIncompleteFromTheFirstMessageThatIsNotInTheLog) {
  FlightWatch watch(scenario(), kStart);
  EXPECT_FALSE(watch.summary({}).recording) << "no logger was heard";
  watch.receive(logger(0.0), kStart);
  watch.receive(logger(0.5), kStart);
  EXPECT_EQ(watch.summary({}).recording, "");
  watch.receive(logger(1.0, ProcessState::Failed, "the disk is full"), kStart);
  EXPECT_EQ(watch.live().waiting, "tern-logger: the disk is full") << "the live line says so at once";
  watch.receive(logger(1.5), kStart);
  EXPECT_EQ(watch.summary({}).recording, "the disk is full");
}

TEST(FlightWatch, ARecordingByALoggerThatDiedOrWasAwayIsIncomplete) {
  FlightWatch dead(scenario(), kStart), away(scenario(), kStart), restarted(scenario(), kStart);
  for (FlightWatch* watch : {&dead, &away, &restarted}) watch->receive(logger(0.0), kStart);
  restarted.receive(logger(2.0), kStart);
  away.receive(logger(4.0), kStart);
  Heartbeat last = simulator(1);
  last.header.utime = kStart + Duration{4'000'000};
  for (FlightWatch* watch : {&dead, &away, &restarted}) watch->receive(last, kStart);
  EXPECT_EQ(dead.summary({}).recording, "tern-logger was silent for 4.0 s");
  EXPECT_EQ(away.summary({}).recording, "tern-logger was silent for 4.0 s");
  EXPECT_EQ(restarted.summary({}).recording, "") << "four heartbeats may be lost";
}

TEST(FlightWatch, ARecordingByALoggerThatAnotherOneFollowsInFlightIsIncomplete) {
  const auto successor = [](double seconds) {
    Heartbeat heartbeat = logger(seconds);
    heartbeat.header.name.sender_epoch_us = 100;
    return heartbeat;
  };
  FlightWatch before(scenario(), kStart), followed(scenario(), kStart), beside(scenario(), kStart);
  for (FlightWatch* watch : {&before, &followed, &beside}) watch->receive(logger(0.0), kStart);
  before.receive(successor(0.4), kStart);
  for (FlightWatch* watch : {&before, &followed, &beside}) {
    watch->receive(request(), kStart);
    watch->receive(successor(1.0), kStart);
  }
  beside.receive(logger(1.1), kStart);
  for (FlightWatch* watch : {&before, &followed, &beside}) watch->receive(successor(1.5), kStart);
  EXPECT_EQ(before.summary({}).recording, "") << "no flight begins before the logger has all it needs";
  EXPECT_EQ(followed.summary({}).recording, "tern-logger restarted during the flight");
  EXPECT_EQ(beside.summary({}).recording, "");
}

TEST(FlightWatch, WhatComesAfterTheVerdictExplainsNothing) {
  FlightWatch watch(scenario(), kStart);
  watch.receive(simulator(5), kStart);
  watch.receive(executor(), kStart);
  watch.receive(request(), kStart);
  watch.receive(state(Vec3(0, 0, 1), Vec3(2, 0, 0), kStart));
  FlightResult result = verdict_of(5, FlightOutcome::Collision);
  result.detail = "touched obstacle 3 at 0.100 s";
  result.contacts_moving = 1;
  watch.receive(result, kStart);
  watch.receive(state(Vec3(0, 0, 1), Vec3::Zero(), kStart + Duration{500'000}));
  EXPECT_EQ(watch.summary({result.outcome, result.detail})
                .explanation.sentence.find("touched obstacle 3 at 0.100 s, flying at 2.0 m/s"),
            0U);
}

}  // namespace
}  // namespace tern
