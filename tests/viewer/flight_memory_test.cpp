// The memory of a flight: its numbers, its path, its events.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "tests/viewer/known_scene.h"
#include "viewer/bridge/flight_events.h"
#include "viewer/bridge/flight_history.h"
#include "viewer/bridge/scene.h"
#include "viewer/bridge/scene_json.h"
#include "viewer/bridge/topics.h"

namespace tern {
namespace {

using nlohmann::json;

constexpr UTime kStart{1'000'000'000};

UTime at(double seconds) { return kStart + Duration::from_seconds(seconds); }

UavState state_at(double seconds, const Vec3& p, const Vec3& v) {
  UavState state;
  state.at = at(seconds);
  state.motion.p = p;
  state.motion.v = v;
  return state;
}

/// 60 s along x at 1 m/s.
FlightHistory straight_flight() {
  FlightHistory history;
  for (int k = 0; k <= 6'000; ++k) history.add(state_at(0.01 * k, Vec3(0.01 * k, 0.0, 1.0), Vec3(1.0, 0.0, 0.0)));
  return history;
}

json path(const FlightHistory& history, UTime zero, UTime until, std::size_t most = 3'000) {
  JsonWriter writer;
  writer.begin_object();
  history.write_path(writer, zero, until, most);
  return json::parse(writer.end_object().take());
}

TEST(FlightHistory, TellsTheWholePathWithItsTimes) {
  const FlightHistory history = straight_flight();
  const json all = path(history, kStart, at(60.0));
  ASSERT_EQ(all["t"].size(), 1'201U);
  ASSERT_EQ(all["curve"].size(), 4 * 1'201U);
  for (std::size_t k = 0; k < all["t"].size(); ++k) EXPECT_EQ(all["t"][k], all["curve"][4 * k]);
  EXPECT_LE(path(history, kStart, at(60.0), 100)["t"].size(), 100U);
  EXPECT_EQ(path(history, kStart, at(30.0))["t"].back(), 30.0);
  EXPECT_EQ(history.departure(), kStart);
  EXPECT_EQ(FlightHistory().departure(), std::nullopt);
}

RC_GTEST_PROP(FlightHistory, ThinsASeriesWithoutLosingAnExtreme, ()) {
  const auto values = *rc::gen::container<std::vector<double>>(
      200, rc::gen::map(rc::gen::inRange(-999, 999), [](int x) { return 0.5 * x; }));
  FlightHistory history;
  for (std::size_t k = 0; k < values.size(); ++k)
    history.add_row("T", at(0.1 * static_cast<double>(k)), {{"T.x", values[k]}});
  const json chart = json::parse(history.chart_json(kStart, at(100.0), {"T.x", "T.none"}, 10));
  const json& series = chart["series"]["T.x"];
  RC_ASSERT(!chart["series"].contains("T.none"));
  RC_ASSERT(series[0].size() == series[1].size() && series[0].size() <= 20U);
  RC_ASSERT(std::is_sorted(series[0].begin(), series[0].end()));
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  RC_ASSERT(*std::min_element(series[1].begin(), series[1].end()) == *least);
  RC_ASSERT(*std::max_element(series[1].begin(), series[1].end()) == *greatest);
}

TEST(FlightHistory, KeepsARowPerFiftyMillisecondsAndWhatIsNoNumberAsNone) {
  FlightHistory history;
  EXPECT_TRUE(history.add_row("T", at(0.0), {{"T.a", 1.0}, {"T.b", 2.0}}));
  EXPECT_FALSE(history.add_row("T", at(0.02), {{"T.a", 7.0}, {"T.b", 7.0}}));
  EXPECT_FALSE(history.add_row("T", at(0.1), {{"T.b", 3.0}}));
  const json chart = json::parse(history.chart_json(kStart, at(1.0), {"T.a", "T.b"}));
  EXPECT_EQ(chart["series"]["T.a"], json::parse("[[0,0.1],[1,null]]"));
  EXPECT_EQ(chart["series"]["T.b"], json::parse("[[0,0.1],[2,3]]"));
  EXPECT_EQ(history.fields(), (std::vector<std::string>{"T.a", "T.b"}));
}

TEST(FlightHistory, HasEveryNumberOfAMessage) {
  const support::KnownScene known(kStart);
  Scene scene;
  scene.receive(known.state(at(2.0)));
  const NumberFields fields = vehicle_numbers(scene);
  const auto value = [&](const std::string& name) {
    const auto found = std::find_if(fields.begin(), fields.end(), [&](const auto& f) { return f.first == name; });
    return found == fields.end() ? -1.0 : found->second;
  };
  EXPECT_EQ(value("UAV_STATE.position_m.x"), 2.0);
  EXPECT_EQ(value("UAV_STATE.velocity_mps.x"), 1.0);
  EXPECT_EQ(value("UAV_STATE.speed_mps"), 1.0);
  for (const auto& [name, number] : fields) EXPECT_FALSE(name.ends_with("_us")) << name;
}

TEST(FlightHistory, HasTheNumbersThatTheInspectorShows) {
  const support::KnownScene known(kStart);
  Scene scene;
  const HorizonRequest request = known.request(at(2.0), 3);
  scene.receive(request);
  scene.receive(known.plan(request));
  scene.receive(known.timing(request.id));
  std::map<std::string, double> numbers;
  for (const auto& [name, number] : plan_numbers(scene)) numbers[name] = number;
  std::size_t compared = 0;
  const json detail = json::parse(detail_json(scene, {PickKind::Plan, 0, ""}));
  for (const json& message : detail["messages"]) {
    const std::string channel = message["channel"].get<std::string>() + ".";
    for (const auto& [key, value] : message.items()) {
      if (!value.is_number() || key.ends_with("_us")) continue;
      EXPECT_NEAR(numbers.at(channel + key), value.get<double>(), 5.1e-5) << channel << key;
      ++compared;
    }
  }
  EXPECT_GT(compared, 20U);
}

HorizonRequest request_at(double seconds) {
  HorizonRequest request;
  request.header.utime = at(seconds);
  return request;
}

Goal goal_at(double seconds, GoalMode mode) {
  Goal goal;
  goal.header.utime = at(seconds);
  goal.mode = mode;
  return goal;
}

TEST(WorldTime, BeginsWithTheFirstRequest) {
  WorldTime time;
  EXPECT_EQ(time.zero(), std::nullopt);
  time.receive(goal_at(1.0, GoalMode::Go));
  EXPECT_EQ(time.zero(), std::nullopt);
  for (const double t : {2.0, 2.05}) time.receive(request_at(t));
  EXPECT_EQ(time.zero(), at(2.0));
}

TEST(WorldTime, OfAVehicleThatIsToldToHoldFirstBeginsWhenItIsToGo) {
  WorldTime time;
  time.receive(goal_at(1.0, GoalMode::Hold));
  time.receive(request_at(2.0));
  time.receive(goal_at(9.0, GoalMode::Go));
  time.receive(request_at(8.99));  ///< the goal overtook it
  EXPECT_EQ(time.zero(), std::nullopt);
  time.receive(request_at(9.05));
  time.receive(goal_at(20.0, GoalMode::Go));
  time.receive(request_at(21.0));
  EXPECT_EQ(time.zero(), at(9.05));
}

TEST(Scene, CountsTimeFromWorldTime0) {
  Scene::Memory memory;
  Scene scene(&memory);
  scene.receive(state_at(0.0, Vec3::Zero(), Vec3::Zero()));
  EXPECT_EQ(memory.zero(), kStart) << "as long as it is not known";
  scene.receive(request_at(3.0));
  EXPECT_EQ(memory.zero(), at(3.0));
  const json chart = json::parse(memory.history.chart_json(memory.zero(), at(5.0), {}));
  EXPECT_EQ(chart["begin_s"], -3.0);
  EXPECT_EQ(chart["end_s"], 2.0);
}

TEST(Scene, RemembersClearancesToObstaclesAndToTheMapApart) {
  const support::KnownScene known(kStart);
  Scene::Memory memory;
  Scene scene(&memory);
  VoxelMap map = known.map();
  for (VoxelLabel& label : map.labels) label = label == VoxelLabel::Repulsive ? VoxelLabel::Occupied : label;
  scene.receive(map);
  scene.receive(known.request(kStart, 1));  ///< a ball of 0.1 m
  scene.receive(known.truth(kStart));
  scene.receive(known.state(kStart));
  const json chart =
      json::parse(memory.history.chart_json(kStart, kStart, {"clearance.obstacles_m", "clearance.map_m"}));
  EXPECT_NEAR(chart["series"]["clearance.obstacles_m"][1][0].get<double>(), *scene.clearance(), 1e-4);
  // Occupied: x 7 … 9, y −2 … −1.5, z 0 … 2; the vehicle is at (0, 0, 1).
  EXPECT_NEAR(chart["series"]["clearance.map_m"][1][0].get<double>(), std::hypot(7.0, 1.5) - 0.1, 1e-4);
}

std::vector<std::string> events_of(const FlightEvents& events, const std::string& kind) {
  std::vector<std::string> texts;
  for (const FlightEvent& event : events.events()) {
    if (event.kind == kind) texts.push_back(event.text);
  }
  return texts;
}

using Texts = std::vector<std::string>;

TEST(FlightEvents, AreTheChangesOfTheOutcome) {
  FlightEvents events;
  Plan plan;
  for (const auto& [outcome, reason] :
       {std::pair(PlanOutcome::Optimized, PlanReason::None), std::pair(PlanOutcome::Optimized, PlanReason::None),
        std::pair(PlanOutcome::KeepCommitted, PlanReason::WorsePlan),
        std::pair(PlanOutcome::Evade, PlanReason::None)}) {
    plan.outcome = outcome;
    plan.reason = reason;
    events.receive(plan);
  }
  EXPECT_EQ(events_of(events, "outcome"),
            (Texts{"first answer: optimized", "optimized → keep committed (worse plan)"}));
  EXPECT_EQ(events_of(events, "evasion"), Texts{"keep committed → evade"});
}

TEST(FlightEvents, AreGoalsStopsLateAnswersRestartsAndTheResultOnce) {
  FlightEvents events;
  Goal goal;
  goal.id = 1;
  goal.position = Vec3(1.0, 2.0, 3.0);
  events.receive(goal);
  events.receive(goal);
  goal.id = 2;
  goal.mode = GoalMode::Hold;
  events.receive(goal);
  EXPECT_EQ(events_of(events, "goal"), (Texts{"goal 1: 1.0, 2.0, 3.0", "goal 2: hold"}));
  for (const double speed : {0.0, 3.0, 0.2, 0.0, 0.0, 0.2, 0.0}) {
    events.receive(state_at(0.0, Vec3(1.0, 0.0, 0.0), Vec3(speed, 0.0, 0.0)));
  }
  EXPECT_EQ(events_of(events, "stop"), Texts{"at rest at 1.0, 0.0, 0.0"});
  PlanTiming timing;
  timing.request_id = 5;
  events.receive(timing, 80.0, 0.0);
  events.receive(timing, 80.0, 90.0);
  events.receive(timing, 80.0, 70.0);
  EXPECT_EQ(events_of(events, "late"), Texts{"answer 5: 80.0 of 70 ms"});
  Heartbeat heartbeat;
  heartbeat.process = "tern-planner";
  for (const std::int64_t epoch : {1, 1, 2, 2}) {
    heartbeat.header.name.sender_epoch_us = epoch;
    events.receive(heartbeat);
  }
  EXPECT_EQ(events_of(events, "restart"), Texts{"tern-planner restarted"});
  FlightResult result;
  result.outcome = FlightOutcome::Collision;
  result.detail = "mover 3";
  events.receive(result);
  events.receive(result);
  EXPECT_EQ(events_of(events, "result"), Texts{"collision: mover 3"});
}

TEST(Scene, CallsAnAnswerLateByTheFlightsClockWhateverThePace) {
  const support::KnownScene known(kStart);
  Scene::Memory memory;
  Scene scene(&memory);
  for (const std::int64_t id : {1, 2}) {  ///< 70 ms are allowed; at half the pace, 80 ms of the wall are 40 ms
    const HorizonRequest request = known.request(at(0.1 * static_cast<double>(id)), id);
    Plan plan = known.plan(request);
    plan.header.utime = request.header.utime + Duration{40'000 * id};
    PlanTiming timing = known.timing(id);
    timing.header.utime = plan.header.utime;
    timing.total_ms = 80.0;
    scene.receive(request);
    scene.receive(plan);
    scene.receive(timing);
    EXPECT_EQ(json::parse(timing_json(scene))["late"], id == 2);
  }
  EXPECT_EQ(events_of(memory.events, "late"), Texts{"answer 2: 80.0 of 70 ms"});
}

TEST(FlightEvents, AreTheFiveNearestPasses) {
  FlightEvents events;
  for (int k = 0; k <= 2'000; ++k) {
    const double t = 0.01 * k;
    // Passes at t = 1, 3, 5 …, each nearer than the last by 0.04 m; at 1 m between them.
    events.receive_clearance(at(t), 0.55 - 0.02 * t + 0.45 * std::cos(M_PI * t), std::nullopt);
  }
  const Texts passes = events_of(events, "clearance");
  EXPECT_EQ(passes.size(), 5U);
  EXPECT_NE(passes.back().find("-0.280 m to an obstacle, the least"), std::string::npos) << passes.back();
  EXPECT_EQ(events_of(FlightEvents(), "clearance"), Texts{});
}

TEST(Topics, AGhostDepartsWhenTheFlightDoes) {
  FlightHistory shown = straight_flight(), other;
  for (int k = 0; k <= 100; ++k) {
    const double t = 0.1 * k, x = std::max(t - 3.0, 0.0);  ///< departs 3 s after the first state
    other.add(state_at(100.0 + t, Vec3(x, 5.0, 1.0), Vec3(t > 3.0 ? 1.0 : 0.0, 0.0, 0.0)));
  }
  const json ghost = json::parse(ghost_json("b", 0.2, other, shown, kStart));
  for (std::size_t k = 0; k < ghost["t"].size(); ++k) {
    if (ghost["t"][k] < 0.0) continue;
    EXPECT_NEAR(ghost["curve"][4 * k].get<double>(), ghost["t"][k].get<double>() + 0.1, 1e-3);
  }
  EXPECT_EQ(ghost_json("b", 0.2, FlightHistory(), shown, kStart), "null");
}

}  // namespace
}  // namespace tern
