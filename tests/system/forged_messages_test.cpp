// One or two forged packets, or a second process by mistake, have no lasting effect on a flight without keys.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "campaign/virtual_system.h"
#include "core/wire/message_limits.h"
#include "executor/app/executor_node.h"
#include "messages/codec.h"
#include "monitor/app/monitor_node.h"
#include "predictor/app/predictor_node.h"
#include "simulator/app/simulator_node.h"
#include "tests/support/forger.h"
#include "tests/support/watched_flight.h"

namespace tern::testing {
namespace {

constexpr std::int64_t kFar = std::int64_t{1} << 62;
/// Pillars and moving obstacles on the path: a planner in an empty world, or none, collides with them.
constexpr char kObstacles[] =
    "world.obstacles=["
    "{motion: trefoil, centre: [8, 0.5, 1], slowness: 1.1}, {centre: [14, -1, 2], half_extents: [0.2, 0.2, 4]},"
    "{motion: trefoil, centre: [28, 0, 1], slowness: 1.1}, {centre: [36, 0, 2], half_extents: [0.2, 0.2, 4]},"
    "{motion: trefoil, centre: [52, -0.5, 2], slowness: 1.1, phase: 2}]";

/// A flight of all processes and the monitor, in which a test forges messages from the second second on.
class ForgedMessages : public ::testing::Test {
 protected:
  ForgedMessages()
      : system_(scenario_file("paper_corridor"), {"world.generator=none", "world.count=0", kObstacles}),
        forger_(system_.runner()),
        summary_(::testing::TempDir() + "/forged" + std::to_string(getpid()) + ".json") {
    MonitorOptions options;
    options.summary_file = summary_;
    runner().start("tern-monitor",
                   [&](Bus& bus) { return std::make_unique<MonitorNode>(bus, system_.scenario(), options); });
    Bus& bus = runner().observer();
    bus.subscribe(channels::kPlan, [this](const Plan& plan) { plans_.push_back(plan); });
    runner().run(runner().now() + Duration::from_seconds(20.0),
                 [this] { return simulator().world_zero().has_value(); });
    fly(2.3);
    EXPECT_GT(speed(), 2.0);
  }
  ~ForgedMessages() override { std::filesystem::remove(summary_); }

  [[nodiscard]] VirtualRunner& runner() { return system_.runner(); }
  [[nodiscard]] const SimulatorNode& simulator() { return system_.simulator(); }
  [[nodiscard]] const Executor& executor() { return *system_.executor().executor(); }
  [[nodiscard]] double speed() { return executor().sample(runner().now()).v.norm(); }
  void fly(double seconds) { runner().run(runner().now() + Duration::from_seconds(seconds)); }
  /// Runs to the monitor's end. @return the number of answers from here on with the reason StaleWorld
  std::int64_t fly_to_the_goal() {
    const std::size_t before = plans_.size();
    const RunResult end = runner().run(runner().now() + Duration::from_seconds(60.0));
    EXPECT_EQ(end.process, "tern-monitor");
    EXPECT_EQ(end.exit_code, 0);
    EXPECT_TRUE(simulator().result());
    if (simulator().result()) expect_reached(*simulator().result());
    return std::count_if(plans_.begin() + static_cast<std::ptrdiff_t>(before), plans_.end(),
                         [](const Plan& plan) { return plan.reason == PlanReason::StaleWorld; });
  }
  /// Expects no effect: every request is answered, with a plan.
  void expect_undisturbed() {
    EXPECT_EQ(fly_to_the_goal(), 0);
    EXPECT_EQ(executor().counters().unanswered, 0);
    EXPECT_EQ(executor().counters().refused(), 0);
    EXPECT_EQ(summary()["outcome"], "reached");
    EXPECT_EQ(summary()["restarts"], 0);
    for (const auto& [channel, count] : summary()["messages"].items()) EXPECT_EQ(count["lost"], 0) << channel;
  }
  [[nodiscard]] nlohmann::json summary() const {
    std::ifstream file(summary_);
    return nlohmann::json::parse(file);
  }
  [[nodiscard]] TrackSet empty_world(std::int64_t set = 1, std::int32_t count = 1) {
    TrackSet world;
    world.batch = {set, 0, count};
    world.made_at = runner().now();
    return world;
  }
  [[nodiscard]] Goal goal(std::int64_t id, GoalMode mode, const Vec3& position = Vec3::Zero()) {
    Goal goal;
    goal.id = id;
    goal.mode = mode;
    goal.position = position;
    return goal;
  }

  VirtualSystem system_;
  Forger forger_;
  std::string summary_;
  std::vector<Plan> plans_;
};

TEST_F(ForgedMessages, AnEmptyWorldFromTheFutureIsNotBelieved) {
  TrackSet world = empty_world();
  world.made_at = runner().now() + Duration{1'000'000'000'000};
  forger_.send(channels::kPredictions.name, world, {{3'999'999'999'999'999, 1}, runner().now()});
  forger_.send(channels::kPredictions.name, world, forger_.foreign());
  forger_.send(channels::kPredictions.name, world, forger_.next(channels::kPredictions.name));
  expect_undisturbed();
}

TEST_F(ForgedMessages, AnEmptyWorldOfAnotherPredictorIsNotBelieved) {
  forger_.send(channels::kPredictions.name, empty_world(kFar), forger_.foreign());
  forger_.send(channels::kPredictions.name, empty_world(kFar, 2), forger_.foreign(2));
  expect_undisturbed();
}

TEST_F(ForgedMessages, HalfASetOfTheTruePredictorDelaysTheWorldByOneSet) {
  forger_.send(channels::kPredictions.name, empty_world(kFar, 2), forger_.next(channels::kPredictions.name));
  expect_undisturbed();
}

TEST_F(ForgedMessages, AWorldOfTheTruePredictorIsBelievedUntilTheNextSet) {
  // Without keys it cannot be told from a true message.
  fly(0.01);
  const UTime lied = runner().now();
  TrackSet lie = empty_world(kFar);
  lie.batch.set = 123'456'789;
  forger_.send(channels::kPredictions.name, lie, forger_.next(channels::kPredictions.name));
  fly(1.0);
  for (const Plan& plan : plans_) {
    const bool later = plan.header.utime > lied + Duration{150'000};
    EXPECT_FALSE(later && plan.inputs.prediction_set == lie.batch.set);
  }
  EXPECT_EQ(fly_to_the_goal(), 0);
}

TEST_F(ForgedMessages, AFarSequenceMutesNoTrueRequest) {
  Header header = forger_.next(channels::kHorizonRequest.name);
  header.name.sequence = kFar;
  forger_.send(channels::kHorizonRequest.name, forger_.newest_request(), header);
  expect_undisturbed();
}

TEST_F(ForgedMessages, ARequestOfTheTrueExecutorMutesNoneForLong) {
  Header header = forger_.next(channels::kHorizonRequest.name);
  header.name.sequence += 7;
  header.utime = header.utime + Duration{100'000};
  HorizonRequest request = forger_.newest_request();
  request.id = kFar;
  request.t_s = header.utime + Duration{75'000};
  request.deadline = request.t_s - Duration{5'000};
  forger_.send(channels::kHorizonRequest.name, request, header);
  EXPECT_EQ(fly_to_the_goal(), 0);
  EXPECT_LE(executor().counters().unanswered, 4);
}

TEST_F(ForgedMessages, APlanOfAnotherPlannerIsNotAdopted) {
  const HorizonRequest asked = forger_.newest_request();
  const auto adopted = executor().counters().of(Verdict::Adopted);
  for (std::int64_t ahead = 0; ahead < 4; ++ahead) {
    Plan plan;
    plan.request_id = asked.id + ahead;
    plan.outcome = PlanOutcome::Optimized;
    plan.trajectory = asked.committed;
    forger_.send(channels::kPlan.name, plan, forger_.foreign(1 + ahead));
  }
  fly(0.001);
  EXPECT_EQ(executor().counters().of(Verdict::Adopted), adopted);
  expect_undisturbed();
}

TEST_F(ForgedMessages, AStopFromTheFutureStopsNobody) {
  forger_.send(channels::kGoal.name, goal(kMaxGoalId, GoalMode::Stop), forger_.foreign(1));
  forger_.send(channels::kGoal.name, goal(kFar, GoalMode::Stop), forger_.foreign(2));
  forger_.send(channels::kGoal.name, goal(kFar, GoalMode::Stop), forger_.next(channels::kGoal.name));
  expect_undisturbed();
}

TEST_F(ForgedMessages, AStopOfNowIsBelievedAndALaterGoalIsHeardAfterIt) {
  // Anyone may send goals; only keys restrict the sender.
  forger_.send(channels::kGoal.name, goal(runner().now().us, GoalMode::Stop), forger_.foreign());
  fly(3.0);
  EXPECT_EQ(speed(), 0.0);
  forger_.send(channels::kGoal.name, goal(runner().now().us, GoalMode::Go, system_.scenario().uav.goal),
               forger_.foreign(2));
  EXPECT_EQ(fly_to_the_goal(), 0);
}

TEST_F(ForgedMessages, AGoalInTheVehiclesNameIsBelievedAsAnybodysIs) {
  forger_.send(channels::kGoal.name, goal(77, GoalMode::Go, Vec3(1e6, 1e6, 1e6)), forger_.next(channels::kGoal.name));
  fly(1.0);
  forger_.send(channels::kGoal.name, goal(78, GoalMode::Go, system_.scenario().uav.goal), forger_.foreign(2));
  EXPECT_EQ(fly_to_the_goal(), 0);
  EXPECT_LT(simulator().result()->flight_time_s, 18.0);
}

TEST_F(ForgedMessages, TwoStatesInTheVehiclesNameMoveNobody) {
  Header header = forger_.next(channels::kUavState.name);
  for (int k = 0; k < 2; ++k) {
    UavState lie;
    lie.at = runner().now() + Duration{30'000 * k};
    lie.motion.p = executor().sample(runner().now()).p + Vec3(4.0, 1.0, 0.0);
    forger_.send(channels::kUavState.name, lie, header);
    ++header.name.sequence;
  }
  expect_undisturbed();
  EXPECT_EQ(system_.executor().tube_exits(), 0);
}

TEST_F(ForgedMessages, AStateInTheVehiclesNameThatIsALittleOffMakesNoTube) {
  UavState lie;
  lie.at = runner().now();
  lie.motion = executor().sample(lie.at);
  lie.motion.p.y() += 0.002;
  forger_.send(channels::kUavState.name, lie, forger_.next(channels::kUavState.name));
  fly(1.0);
  EXPECT_EQ(executor().tube(), Vec3(Vec3::Zero()));
  expect_undisturbed();
}

TEST_F(ForgedMessages, AVerdictOfAnotherSimulatorEndsNothing) {
  FlightResult result;
  result.outcome = FlightOutcome::Reached;
  forger_.send(channels::kFlightResult.name, result, forger_.foreign());
  expect_undisturbed();
}

TEST_F(ForgedMessages, AVerdictInTheSimulatorsNameIsDroppedWhenItFliesOn) {
  FlightResult result;
  result.outcome = FlightOutcome::Collision;
  Header header = forger_.next(channels::kUavState.name);
  header.name.sequence = 1;
  forger_.send(channels::kFlightResult.name, result, header);
  fly_to_the_goal();
  EXPECT_EQ(summary()["outcome"], "reached");
}

TEST_F(ForgedMessages, AHeartbeatOfAnotherSimulatorEndsNothing) {
  Heartbeat heartbeat;
  heartbeat.process = kSimulatorProcess;
  heartbeat.state = ProcessState::Ready;
  forger_.send(channels::kHeartbeat.name, heartbeat, forger_.foreign());
  forger_.send(channels::kHeartbeat.name, heartbeat, {{3'999'999'999'999'999, 1}, runner().now()});
  heartbeat.channels["GOAL"].lost = kFar;
  forger_.send(channels::kHeartbeat.name, heartbeat, {{5, 1}, UTime{3'999'999'999'999'999}});
  expect_undisturbed();
}

TEST_F(ForgedMessages, MotionsOfAnotherOwnerAreNotDeclared) {
  TrackSet world = empty_world(kFar);
  forger_.send(channels::kDeclaredMotions.name, world, {{3'999'999'999'999'999, 1}, runner().now()});
  forger_.send(channels::kDeclaredMotions.name, world, forger_.foreign(1));
  world.tracks.resize(1);
  world.tracks[0].id = 1;
  world.tracks[0].half_extents = Vec3::Constant(1e5);
  world.tracks[0].motion = {runner().now(), {CubicPiece{Duration{5'000'000}, PowerCubic::Zero()}}};
  world.tracks[0].alpha.assign(1, Vec3::Zero());
  forger_.send(channels::kDeclaredMotions.name, world, forger_.foreign(2));
  expect_undisturbed();
}

TEST_F(ForgedMessages, MotionsInTheTrueOwnersNameLastUntilItsNextSet) {
  TrackSet world = empty_world(kFar);
  forger_.send(channels::kDeclaredMotions.name, world, forger_.next(channels::kDeclaredMotions.name));
  EXPECT_EQ(fly_to_the_goal(), 0);
}

TEST_F(ForgedMessages, RequestsOfOtherExecutorsTakeNoGoalAway) {
  for (std::int64_t k = 0; k < 300; ++k) {
    HorizonRequest request = forger_.newest_request();
    request.id = 1'000 + k;
    request.t_s = runner().now() + Duration{75'000};
    request.deadline = request.t_s - Duration{5'000};
    forger_.send(channels::kHorizonRequest.name, request,
                 {{k % 2 == 0 ? 5 : runner().now().us, k + 1}, runner().now()});
    fly(0.01);
  }
  expect_undisturbed();
}

TEST_F(ForgedMessages, ASecondPredictorForAWhileBlindsNobody) {
  Heartbeat planner;
  runner().observer().subscribe(channels::kHeartbeat, [&](const Heartbeat& heard) {
    if (heard.process == "tern-planner" && !heard.waiting_for.empty()) planner = heard;
  });
  runner().start("second", [](Bus& bus) { return std::make_unique<PredictorNode>(bus, PredictorConfig()); });
  fly(1.5);
  runner().stop("second");
  EXPECT_EQ(planner.waiting_for, "PREDICTIONS: two senders, only the first is accepted");
  expect_undisturbed();
}

TEST_F(ForgedMessages, AnotherProcessThatSpeaksForASensorMakesNoGhosts) {
  VirtualSystem system(scenario_file("perception_only"), {"world.count=20", "uav.goal=[20, 0, 1]"});
  Forger forger(system.runner());
  std::int64_t ghosts = 0;
  Header header{{1, 0}, {}};
  ObservationSet last;
  system.runner().observer().subscribe(channels::kObstacleObservations, [&](const ObservationSet& true_one) {
    if (true_one.header.name.sender_epoch_us != 1) last = true_one;
  });
  const Vec3 ghost(-3.0, 0.0, 1.0);
  system.runner().observer().subscribe(channels::kPredictions, [&](const TrackSet& set) {
    for (const Track& track : set.tracks) {
      ghosts += (track.motion.pieces.front().coefficients.col(3) - ghost).norm() < 0.5 ? 1 : 0;
    }
  });
  for (int k = 0; k < 100; ++k) {
    system.runner().run(system.runner().now() + Duration::from_seconds(0.033));
    if (last.at == UTime{}) continue;
    ObservationSet lie = last;
    lie.at = system.runner().now();
    lie.detections.assign(1, Detection{});
    lie.detections.front().position = ghost;
    lie.detections.front().half_extents = lie.detections.front().variance = Vec3::Constant(0.1);
    ++header.name.sequence;
    header.utime = lie.at;
    forger.send(channels::kObstacleObservations.name, lie, header);
  }
  EXPECT_GT(header.name.sequence, 20);
  EXPECT_EQ(ghosts, 0);
}

TEST_F(ForgedMessages, WhenTheFirstOfTwoPredictorsEndsTheOtherIsHeard) {
  runner().start("second", [](Bus& bus) { return std::make_unique<PredictorNode>(bus, PredictorConfig()); });
  fly(0.5);
  system_.stop("tern-predictor");
  EXPECT_LE(fly_to_the_goal(), 4);
}

}  // namespace
}  // namespace tern::testing
