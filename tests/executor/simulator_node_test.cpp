// The whole simulator node on virtual time with a stub planner: it flies, judges, waits, and survives faults.
#include "simulator/app/simulator_node.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "executor/app/executor_node.h"
#include "messages/codec.h"
#include "runtime/batches.h"
#include "runtime/process.h"
#include "runtime/virtual_runner.h"
#include "simulator/app/make_vehicle.h"
#include "tests/support/stub_planner.h"

namespace tern {
namespace {

constexpr UTime kStart{1'700'000'000'000'000};
constexpr Duration kSecond{1'000'000};

Scenario empty_scenario() {
  Scenario scenario;
  scenario.name = "empty";
  scenario.uav.goal = Vec3(20.0, -3.0, 2.0);
  return scenario;
}

Scenario with_obstacle(Scenario scenario, ObstacleSpec obstacle) {
  scenario.world.obstacles.push_back(std::move(obstacle));
  return scenario;
}

ObstacleSpec far_trefoil() {
  ObstacleSpec obstacle;
  obstacle.centre = Vec3(10.0, 30.0, 1.0);
  obstacle.motion = TrefoilMotion{Vec3::Ones(), 1.1, 0.4};
  return obstacle;
}

/// A process that receives messages, but gets no processor time for a while.
class HeldUp final : public Node {
 public:
  explicit HeldUp(std::unique_ptr<Node> node) : node_(std::move(node)) {}
  void hold_until(UTime t) { until_ = t; }
  [[nodiscard]] UTime next_wakeup() const override { return std::max(until_, node_->next_wakeup()); }
  void step(UTime now) override {
    if (now >= until_) node_->step(now);
  }
  [[nodiscard]] NodeHealth health() const override { return node_->health(); }
  [[nodiscard]] std::optional<int> finished() const override { return node_->finished(); }

 private:
  std::unique_ptr<Node> node_;
  UTime until_;
};

/// A flight of the simulator, an executor and a stub planner, with the published messages.
struct Flight {
  explicit Flight(const Scenario& scenario, SimulatorConfig config = {}, ExecutorConfig executor_config = {})
      : uav_(scenario.uav), executor_config_(executor_config) {
    config.wait_for = {"tern-executor", "tern-planner"};
    Bus& ear = runner.observer();
    ear.subscribe(channels::kHorizonRequest, [this](const HorizonRequest& m) { requests.push_back(m); });
    ear.subscribe(channels::kPlan, [this](const Plan& m) { plans.push_back({m, runner.now()}); });
    ear.subscribe(channels::kUavState, [this](const UavState& m) { states.push_back(m); });
    ear.subscribe(channels::kFlightResult, [this](const FlightResult& m) { results.push_back(m); });
    ear.subscribe(channels::kObstacleTruth, [this](const ObstacleTruth& m) { truths.push_back(m); });
    ear.subscribe(channels::kObstacleObservations, [this](const ObservationSet& m) {
      observations.push_back({m, runner.now()});
    });
    ear.subscribe(channels::kGoal, [this](const Goal& m) { goals.push_back(m); });
    World world = make_world(scenario, "").value();
    simulator_process = &runner.start("tern-simulator", [&](Bus& bus) -> std::unique_ptr<Node> {
      auto vehicle = make_vehicle(scenario, config, bus.clock().now());
      auto node = std::make_unique<SimulatorNode>(bus, scenario, std::move(world), std::move(vehicle), config);
      simulator = node.get();
      return std::make_unique<HeldUp>(std::move(node));
    });
    start_executor();
  }

  void start_executor() {
    executor_process = &runner.start("tern-executor", [&](Bus& bus) -> std::unique_ptr<Node> {
      auto node = std::make_unique<ExecutorNode>(bus, uav_, executor_config_);
      executor = node.get();
      return std::make_unique<HeldUp>(std::move(node));
    });
  }

  void start_planner(const StubPlannerOptions& options = {}) {
    runner.start("tern-planner", [&](Bus& bus) { return std::make_unique<StubPlannerNode>(bus, options); });
  }

  void hold_up(Node* process, Duration span) { dynamic_cast<HeldUp&>(*process).hold_until(runner.now() + span); }
  RunResult fly(Duration at_most = kSecond * 100) { return runner.run(runner.now() + at_most); }

  struct Answer {
    Plan plan;
    UTime at;
  };
  struct Observed {
    ObservationSet set;
    UTime at;
  };
  VirtualRunner runner{kStart};
  Node *simulator_process = nullptr, *executor_process = nullptr;
  SimulatorNode* simulator = nullptr;
  ExecutorNode* executor = nullptr;
  std::vector<HorizonRequest> requests;
  std::vector<Answer> plans;
  std::vector<UavState> states;
  std::vector<FlightResult> results;
  std::vector<ObstacleTruth> truths;
  std::vector<Observed> observations;
  std::vector<Goal> goals;

 private:
  UavSpec uav_;
  ExecutorConfig executor_config_;
};

TEST(SimulatorNode, FliesToTheGoalWithEveryRequestAnsweredOnceAndInTime) {
  Flight flight(empty_scenario());
  flight.start_planner();
  const RunResult end = flight.fly();
  EXPECT_EQ(end.end, RunEnd::Finished);
  EXPECT_EQ(end.exit_code, 0);
  ASSERT_EQ(flight.results.size(), 6U);
  const FlightResult& result = flight.results.front();
  EXPECT_EQ(result.outcome, FlightOutcome::Reached) << result.detail;
  EXPECT_EQ(result.limit_violations, 0);
  EXPECT_GT(result.flight_time_s, 4.0);
  EXPECT_LT(result.flight_time_s, 15.0);
  std::map<std::int64_t, int> answers;
  for (const auto& [plan, at] : flight.plans) {
    const HorizonRequest& request = flight.requests.at(static_cast<std::size_t>(plan.request_id - 1));
    EXPECT_LE(at, request.deadline);
    ++answers[plan.request_id];
  }
  EXPECT_GT(flight.requests.size(), 50U);
  EXPECT_EQ(answers.size(), flight.requests.size());
  for (const auto& [id, count] : answers) EXPECT_EQ(count, 1) << "request " << id;
  const ExecutorCounters counters = flight.executor->counters();
  EXPECT_EQ(counters.answered_in_time, counters.requests);
  EXPECT_EQ(counters.refused(), 0);
}

TEST(SimulatorNode, FliesTheSameTwice) {
  std::vector<UavState> first;
  for (int round = 0; round < 2; ++round) {
    Flight flight(empty_scenario());
    flight.start_planner();
    flight.fly();
    if (round == 0) {
      first = flight.states;
      continue;
    }
    ASSERT_EQ(flight.states.size(), first.size());
    for (std::size_t k = 0; k < first.size(); ++k) {
      ASSERT_EQ(flight.states[k].at, first[k].at);
      ASSERT_EQ(flight.states[k].motion.p, first[k].motion.p);
    }
  }
}

TEST(SimulatorNode, PublishesStateAt100HzWithoutAGapOrAJump) {
  Flight flight(empty_scenario());
  flight.start_planner();
  flight.fly();
  for (std::size_t k = 1; k < flight.states.size(); ++k) {
    ASSERT_EQ((flight.states[k].at - flight.states[k - 1].at).us, 10'000);
    const Vec3 step = flight.states[k].motion.p - flight.states[k - 1].motion.p;
    ASSERT_LE(step.cwiseAbs().maxCoeff(), 0.0601);
  }
}

TEST(SimulatorNode, WithoutAPlannerFailsNamingItAndExits3) {
  Flight flight(empty_scenario());
  const RunResult end = flight.fly();
  EXPECT_EQ(end.end, RunEnd::Finished);
  EXPECT_EQ(end.exit_code, kExitNotReady);
  ASSERT_FALSE(flight.results.empty());
  EXPECT_EQ(flight.results.front().outcome, FlightOutcome::Failed);
  EXPECT_THAT(flight.results.front().detail, testing::HasSubstr("tern-planner (no HEARTBEAT)"));
  EXPECT_TRUE(flight.requests.empty());
  EXPECT_NEAR((flight.runner.now() - kStart).seconds(), 16.2, 0.1);
}

TEST(SimulatorNode, WorldTimeStartsAtAWholeMillisecondAfterTheLastProcessIsReady) {
  Flight flight(empty_scenario());
  flight.fly(kSecond * 3);
  EXPECT_FALSE(flight.simulator->world_zero());
  EXPECT_EQ(flight.simulator->health().state, ProcessState::Waiting);
  const UTime planner_start = flight.runner.now();
  flight.start_planner();
  flight.fly(kSecond);
  ASSERT_TRUE(flight.simulator->world_zero());
  const UTime zero = *flight.simulator->world_zero();
  EXPECT_EQ(zero.us % 1'000, 0);
  EXPECT_GE(zero, planner_start + Duration{300'000});
  // Its second heartbeat echoes the simulator's, so the clocks can be compared.
  EXPECT_LE(zero, planner_start + kHeartbeatSpacing + Duration{320'000});
  ASSERT_FALSE(flight.requests.empty());
  EXPECT_EQ(flight.requests.front().t_s, zero + Duration{75'000});
}

TEST(SimulatorNode, AVehicleThatOthersMoveAndCommandMayDepartAtOnceSoWorldTimeStartsAtOnce) {
  const auto zero_after = [](bool sends_goal) {
    SimulatorConfig config;
    config.external = true;
    config.send_goal = sends_goal;
    const Scenario scenario = empty_scenario();
    Flight flight(scenario, config);
    const UTime begin = flight.runner.now();
    flight.start_planner();
    for (int k = 0; k < 50; ++k) {
      UavState state;
      state.at = flight.runner.now();
      state.motion.p = scenario.uav.start;
      flight.runner.observer().publish(channels::kUavState, state);
      VehicleStatus status;
      status.at = state.at;
      status.why_not = "on the ground";
      flight.runner.observer().publish(channels::kVehicleStatus, status);
      flight.fly(Duration{20'000});
    }
    return flight.simulator->world_zero().value_or(kNever) - begin;
  };
  EXPECT_LT(zero_after(true), kSecond);
  EXPECT_EQ(zero_after(true) - zero_after(false), Duration{299'000});
}

TEST(SimulatorNode, UntilWorldZeroEverythingRests) {
  Flight flight(with_obstacle(empty_scenario(), far_trefoil()));
  flight.fly(kSecond * 2);
  ASSERT_GT(flight.truths.size(), 50U);
  ASSERT_GT(flight.observations.size(), 50U);
  flight.start_planner();
  flight.fly(kSecond * 2);
  const UTime zero = *flight.simulator->world_zero();
  const Vec3 resting = flight.truths.front().obstacles.at(0).position;
  bool moved = false;
  for (const ObstacleTruth& truth : flight.truths) {
    if (truth.at <= zero) {
      EXPECT_EQ(truth.obstacles.at(0).position, resting);
    }
    moved = moved || truth.obstacles.at(0).position != resting;
  }
  EXPECT_TRUE(moved);
  for (const auto& [set, at] : flight.observations) {
    if (set.at <= zero) {
      EXPECT_EQ(set.detections.at(0).position, resting);
    }
  }
}

TEST(SimulatorNode, DetectionsFlowWithoutAGapThroughWorldZero) {
  SimulatorConfig config;
  config.sensor = perception_only(3);
  Flight flight(with_obstacle(empty_scenario(), far_trefoil()), config);
  flight.fly(kSecond);
  flight.start_planner();
  flight.fly(kSecond * 2);
  for (std::size_t k = 1; k < flight.observations.size(); ++k) {
    EXPECT_LE((flight.observations[k].at - flight.observations[k - 1].at).us, 2 * 33'334);
    EXPECT_GT(flight.observations[k].set.at, flight.observations[k - 1].set.at);
    EXPECT_NEAR(static_cast<double>((flight.observations[k].at - flight.observations[k].set.at).us), 50'000.0, 1.0);
  }
}

TEST(SimulatorNode, WhatIsDeclaredHoldsFromTheDeclarationOn) {
  Scenario scenario = with_obstacle(empty_scenario(), far_trefoil());
  ObstacleSpec wall;
  wall.centre = Vec3(10.0, 20.0, 1.0);
  scenario = with_obstacle(scenario, wall);
  Flight flight(scenario);
  BatchCollector<TrackSet> collector;
  std::vector<TrackSet> declared;
  flight.runner.observer().subscribe(channels::kDeclaredMotions, [&](const TrackSet& batch) {
    if (auto set = collector.add(batch)) declared.push_back(std::move(set->front()));
  });
  flight.fly(kSecond);
  flight.start_planner();
  flight.fly(kSecond * 6);
  const UTime zero = *flight.simulator->world_zero();
  ASSERT_GT(declared.size(), 25U);
  int checked = 0;
  for (const TrackSet& set : declared) {
    ASSERT_EQ(set.tracks.size(), 2U);
    for (const ObstacleTruth& truth : flight.truths) {
      // A message published before world zero was known is valid until then only.
      if (truth.at < set.made_at || (truth.at > zero && set.made_at <= zero - Duration{300'000})) continue;
      for (const Track& track : set.tracks) {
        const TrueObstacle& o = truth.obstacles.at(static_cast<std::size_t>(track.id));
        EXPECT_TRUE(track.bounds(truth.at, truth.at).contains(box_around(o.position, o.half_extents)))
            << "track " << track.id << ", " << (truth.at - zero).us << " us of world time, declared at "
            << (set.made_at - zero).us;
        ++checked;
      }
    }
  }
  EXPECT_GT(checked, 1'000);
}

TEST(SimulatorNode, DeclaresWhoAppearsWhenItAppears) {
  Scenario scenario = with_obstacle(empty_scenario(), far_trefoil());
  const std::vector<double> appearances = {0.95, 1.05, 1.058};  // s; the last two are closer together than two sets
  for (const double t : appearances) {
    ObstacleSpec person;
    person.motion = WaypointMotion{{{t, Vec3(5, 20, 1)}, {t + 3.0, Vec3(5, 25, 1)}}, false, true};
    scenario = with_obstacle(scenario, person);
  }
  Flight flight(scenario);
  std::map<std::int64_t, UTime> first;
  flight.runner.observer().subscribe(channels::kDeclaredMotions, [&](const TrackSet& batch) {
    for (const Track& track : batch.tracks) first.try_emplace(track.id, flight.runner.now());
  });
  flight.start_planner();
  flight.fly(kSecond * 3);
  const UTime zero = *flight.simulator->world_zero();
  for (std::size_t k = 0; k < appearances.size(); ++k) {
    const UTime there = zero + Duration::from_seconds(appearances[k]);
    const UTime said = first.at(static_cast<std::int64_t>(k) + 1);
    EXPECT_GE(said, there);
    EXPECT_LE((said - there).us, k == 2 ? kDeclaredApart.us : 0) << "obstacle " << k + 1;
  }
}

TEST(SimulatorNode, PerceptionOnlyDeclaresNothing) {
  SimulatorConfig config;
  config.declare = false;
  Flight flight(with_obstacle(empty_scenario(), far_trefoil()), config);
  int declared = 0;
  flight.runner.observer().subscribe(channels::kDeclaredMotions, [&](const TrackSet&) { ++declared; });
  flight.start_planner();
  flight.fly(kSecond * 2);
  EXPECT_EQ(declared, 0);
  EXPECT_GT(flight.observations.size(), 50U);
}

TEST(SimulatorNode, APlannerThatDiesStopsTheVehicleAndItsReturnBringsItHome) {
  Flight flight(empty_scenario());
  flight.start_planner();
  flight.fly(kSecond * 2);
  flight.runner.stop("tern-planner");
  flight.fly(kSecond * 5);
  const MotionSample resting = flight.states.back().motion;
  EXPECT_EQ(resting.v, Vec3::Zero());
  EXPECT_GT((resting.p - empty_scenario().uav.goal).norm(), 1.0);
  EXPECT_GT(flight.executor->counters().unanswered, 40);
  flight.start_planner();
  flight.fly();
  ASSERT_FALSE(flight.results.empty());
  EXPECT_EQ(flight.results.back().outcome, FlightOutcome::Reached) << flight.results.back().detail;
  EXPECT_EQ(flight.results.back().limit_violations, 0);
  EXPECT_EQ(flight.results.back().stops, 1);
}

TEST(SimulatorNode, AnExecutorThatDiesLeavesAVehicleThatRestsAndItsReturnBringsItHome) {
  for (const int died_ms : {1'500, 2'003, 2'061}) {
    Flight flight(empty_scenario());
    flight.start_planner();
    flight.fly(Duration{died_ms * 1'000});
    EXPECT_GT(flight.states.back().motion.v.norm(), 1.0);
    const Vec3 end = flight.requests.back().committed.control_points.rightCols<1>();
    flight.runner.stop("tern-executor");
    flight.fly(kSecond * 5);
    EXPECT_EQ(flight.states.back().motion.v, Vec3::Zero());
    EXPECT_LT((flight.states.back().motion.p - end).norm(), 1e-6);
    flight.start_executor();
    flight.fly();
    ASSERT_FALSE(flight.results.empty());
    EXPECT_EQ(flight.results.back().outcome, FlightOutcome::Reached) << flight.results.back().detail;
    EXPECT_EQ(flight.results.back().limit_violations, 0);
    EXPECT_EQ(flight.results.back().stops, 1);
  }
}

TEST(SimulatorNode, WhoeverIsHeldUpTheVehicleDoesNotJumpAndArrives) {
  for (const bool is_executor : {true, false}) {
    for (const int span_ms : {60, 110, 170, 400, 1'800}) {
      for (const int begins_ms : {1'500, 2'003, 2'018, 2'041}) {
        Flight flight(empty_scenario());
        flight.start_planner();
        flight.fly(Duration{begins_ms * 1'000});
        flight.hold_up(is_executor ? flight.executor_process : flight.simulator_process, Duration{span_ms * 1'000});
        flight.fly();
        ASSERT_FALSE(flight.results.empty());
        const FlightResult& result = flight.results.back();
        EXPECT_EQ(result.outcome, FlightOutcome::Reached) << result.detail;
        EXPECT_EQ(result.limit_violations, 0) << (is_executor ? "executor" : "simulator") << " held up for " << span_ms
                                              << " ms from " << begins_ms << ": " << result.detail;
        EXPECT_TRUE(span_ms > 200 || result.stops == 0) << span_ms << " ms from " << begins_ms;
        EXPECT_EQ(flight.executor->tube_exits(), 0) << "that is no error of tracking";
        EXPECT_TRUE(flight.requests.back().tube.isZero(0.0));
      }
    }
  }
}

TEST(SimulatorNode, NothingIsAskedWhileTheVehicleDoesNotFollow) {
  Flight flight(empty_scenario());
  std::vector<VehicleStatus> statuses;
  flight.runner.observer().subscribe(channels::kVehicleStatus, [&](const VehicleStatus& m) { statuses.push_back(m); });
  flight.fly(kSecond * 2);
  ASSERT_FALSE(statuses.empty());
  EXPECT_EQ(statuses.back().why_not, "world time has not begun");
  EXPECT_TRUE(flight.requests.empty());
  flight.start_planner();
  flight.fly();
  EXPECT_EQ(statuses.back().why_not, "the flight has ended");
  const UTime zero = *flight.simulator->world_zero();
  for (const VehicleStatus& status : statuses) {
    if (status.why_not == "the flight has ended") {
      EXPECT_LE(flight.requests.back().header.utime, status.at);
    } else {
      EXPECT_EQ(status.following, status.at >= zero);
    }
  }
  EXPECT_EQ(flight.requests.front().header.utime, zero);
}

TEST(SimulatorNode, TheTruthOfAPerfectVehicleIsItsSetpointsAndItsState) {
  Flight flight(empty_scenario());
  std::map<UTime, Vec3> commanded, truth;
  Bus& ear = flight.runner.observer();
  ear.subscribe(channels::kSetpoint, [&](const UavState& m) { commanded[m.at] = m.motion.p; });
  ear.subscribe(channels::kVehicleTruth, [&](const UavState& m) { truth[m.at] = m.motion.p; });
  flight.start_planner();
  flight.fly();
  int compared = 0;
  for (const UavState& state : flight.states) {
    if (!truth.contains(state.at) || !commanded.contains(state.at)) continue;
    EXPECT_LT((truth[state.at] - commanded[state.at]).norm(), 1e-9);
    EXPECT_LT((truth[state.at] - state.motion.p).norm(), 1e-6);
    ++compared;
  }
  EXPECT_GT(compared, 500);
}

TEST(SimulatorNode, LateAndRepeatedAnswersAreCountedAndFlyNowhere) {
  Flight flight(empty_scenario());
  flight.start_planner({.delay = Duration{72'000}, .answers = 2, .plan = {}});
  flight.fly();
  ASSERT_FALSE(flight.results.empty());
  EXPECT_EQ(flight.results.back().outcome, FlightOutcome::Timeout);
  EXPECT_EQ(flight.states.back().motion.p, empty_scenario().uav.start);
  const ExecutorCounters counters = flight.executor->counters();
  EXPECT_EQ(counters.answered_in_time, 0);
  EXPECT_EQ(counters.of(Verdict::Late), counters.answered_twice());
  EXPECT_GT(counters.late(), 100);
}

TEST(SimulatorNode, TakesOverANewerGoalAndRepeatsIt) {
  Flight flight(empty_scenario());
  flight.start_planner();
  flight.fly(kSecond * 2);
  Goal goal;
  goal.id = 7;
  goal.position = Vec3(-4.0, 6.0, 3.0);
  flight.runner.observer().publish(channels::kGoal, goal);
  Goal older = goal;
  older.id = 5;
  older.position = Vec3::Zero();
  flight.runner.observer().publish(channels::kGoal, older);
  flight.fly();
  ASSERT_FALSE(flight.results.empty());
  EXPECT_EQ(flight.results.back().outcome, FlightOutcome::Reached) << flight.results.back().detail;
  EXPECT_LT((flight.states.back().motion.p - goal.position).norm(), 0.2);
  EXPECT_EQ(flight.goals.front().id, 1);
  EXPECT_EQ(flight.goals.back().id, 7);
  EXPECT_EQ(flight.goals.back().position, goal.position);
}

TEST(SimulatorNode, WithoutAGoalTheMissionWaits) {
  SimulatorConfig config;
  config.send_goal = false;
  Flight flight(empty_scenario(), config);
  flight.start_planner();
  flight.fly(kSecond * 2);
  EXPECT_TRUE(flight.requests.empty());
  EXPECT_EQ(flight.simulator->health().waiting_for, "a goal");
  Goal goal;
  goal.id = 1;
  goal.position = Vec3(2.0, 0.0, 1.0);
  flight.runner.observer().publish(channels::kGoal, goal);
  flight.fly();
  ASSERT_FALSE(flight.results.empty());
  EXPECT_EQ(flight.results.back().outcome, FlightOutcome::Reached);
}

TEST(SimulatorNode, ACollisionEndsTheFlight) {
  ObstacleSpec intruder;
  intruder.centre = Vec3(0.0, 9.0, 1.0);
  intruder.motion = LinearMotion{Vec3(0.0, -3.0, 0.0), 0.0};
  Scenario scenario = with_obstacle(empty_scenario(), intruder);
  scenario.uav.goal = scenario.uav.start;
  SimulatorConfig config;
  config.min_flight_s = 8.0;
  Flight flight(scenario, config);
  flight.start_planner();
  EXPECT_EQ(flight.fly().exit_code, 0);
  ASSERT_FALSE(flight.results.empty());
  EXPECT_EQ(flight.results.back().outcome, FlightOutcome::Collision);
  EXPECT_NEAR(flight.results.back().flight_time_s, (9.0 - 0.4 - 0.1) / 3.0, 1e-3);
  EXPECT_LT(flight.results.back().min_clearance_m, 0.0);
}

TEST(SimulatorNode, AGuardedPlaceIsReachedWhenTheMinimumFlightIsOver) {
  Scenario scenario = empty_scenario();
  scenario.uav.goal = scenario.uav.start;
  SimulatorConfig config;
  config.min_flight_s = 3.0;
  Flight flight(scenario, config);
  flight.start_planner();
  flight.fly();
  ASSERT_FALSE(flight.results.empty());
  EXPECT_EQ(flight.results.back().outcome, FlightOutcome::Reached);
  EXPECT_NEAR(flight.results.back().flight_time_s, 3.0, 0.011);
}

/// A quadrotor of the camera class, with limits that it can fly.
Scenario gentle_scenario() {
  Scenario scenario = empty_scenario();
  scenario.uav.limits = {Vec3(5, 5, 2), Vec3(5, 5, 3), Vec3::Constant(30.0)};
  return scenario;
}

struct Disturbance {
  const char* name;
  void (*apply)(QuadrotorFlight&);
  bool leaves;          ///< whether it leaves its tube
  bool arrives = true;  ///< by its true position
};

TEST(SimulatorNode, AQuadrotorReachesItsGoalWhateverPushesIt) {
  const Disturbance disturbances[] = {
      {"still air", [](QuadrotorFlight&) {}, false},
      {"wind of 8 m/s with gusts", [](QuadrotorFlight& f) { f.wind.speed = 8.0; }, false},
      {"a gust of 15 m/s", [](QuadrotorFlight& f) { f.wind.burst = 15.0, f.wind.burst_at_s = 3.0; }, false},
      {"a gust of 22 m/s", [](QuadrotorFlight& f) { f.wind.burst = 22.0, f.wind.burst_at_s = 3.0; }, true},
      {"an estimate that jumps by 0.6 m",
       [](QuadrotorFlight& f) { f.estimator.jump_m = 0.6, f.estimator.jump_at_s = 3.0; }, true, false},
      {"a controller three times too soft",
       [](QuadrotorFlight& f) {
         f.quadrotor.controller.position_p /= 3.0;
         f.quadrotor.controller.velocity_p /= 3.0;
         f.quadrotor.controller.velocity_i /= 3.0;
       },
       false}};
  for (const Disturbance& disturbance : disturbances) {
    SCOPED_TRACE(disturbance.name);
    SimulatorConfig config;
    config.quadrotor.emplace();
    disturbance.apply(*config.quadrotor);
    Flight flight(gentle_scenario(), config);
    flight.start_planner();
    flight.fly();
    ASSERT_FALSE(flight.results.empty());
    EXPECT_EQ(flight.results.back().outcome, disturbance.arrives ? FlightOutcome::Reached : FlightOutcome::Timeout)
        << flight.results.back().detail;
    EXPECT_EQ(flight.results.back().limit_violations, 0);
    EXPECT_EQ(flight.executor->tube_exits() > 0, disturbance.leaves) << flight.executor->tube_exits();
    if (!disturbance.leaves) {
      EXPECT_EQ(flight.executor->counters().refused(), 0);
    }
  }
}

TEST(SimulatorNode, WithoutASensorObservesNothing) {
  SimulatorConfig config;
  config.sensor.present = false;
  Flight flight(with_obstacle(empty_scenario(), far_trefoil()), config);
  flight.start_planner();
  flight.fly();
  EXPECT_TRUE(flight.observations.empty());
  EXPECT_FALSE(flight.truths.empty());
  EXPECT_EQ(flight.results.front().obstacles, 1);
}

TEST(SimulatorNode, NeverShowsWhoAppearsBesideTheVehicle) {
  ObstacleSpec person;
  person.motion = WaypointMotion{{{0.5, Vec3(1, 2, 1)}, {60.0, Vec3(1, 2, 1)}}, false, true, 3.0};
  Flight flight(with_obstacle(empty_scenario(), person));
  flight.start_planner();
  flight.fly();
  for (const ObstacleTruth& truth : flight.truths) EXPECT_TRUE(truth.obstacles.empty());
  for (const auto& [set, at] : flight.observations) EXPECT_TRUE(set.detections.empty());
  EXPECT_EQ(flight.results.front().obstacles_left_out, 1);
  EXPECT_EQ(flight.results.front().outcome, FlightOutcome::Reached) << flight.results.front().detail;
}

}  // namespace
}  // namespace tern
