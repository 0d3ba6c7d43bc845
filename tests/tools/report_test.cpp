// A report is one self-contained file; it shows the contents of the log and stays small for a flight of any length.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>

#include "core/scenario/setting.h"
#include "monitor/flight_watch.h"
#include "runtime/clock.h"
#include "tests/support/recorded_flight.h"
#include "tests/support/temp_folder.h"
#include "tools/audit/app/load_flight.h"
#include "tools/report/report_data.h"

namespace tern::report {
namespace {

using audit::Audit;
using audit::FlightRecord;
using ::testing::HasSubstr;
using ::testing::Not;

nlohmann::json data_in(const std::string& page) {
  const std::string begin = "<script type=\"application/json\" id=\"data\">";
  const std::size_t from = page.find(begin) + begin.size();
  return nlohmann::json::parse(page.substr(from, page.find("</script>", from) - from));
}

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

FlightRecord short_flight() { return audit::load_flight(tern::testing::recorded_log("demo")).value(); }

TEST(Report, IsOneFileThatAsksTheNetworkForNothing) {
  const FlightRecord record = short_flight();
  const std::string page = report_page(record, audit::audit_flight(record));
  EXPECT_THAT(page, HasSubstr("default-src 'none'"));
  EXPECT_FALSE(
      std::regex_search(page, std::regex(R"((<link|<img|<iframe|\ssrc=|@import|url\(|fetch\(|XMLHttpRequest))")));
  EXPECT_EQ(count(page, "</script>"), 3U) << "data, charts, page";
  EXPECT_THAT(page, HasSubstr("The MIT License (MIT)"));
}

TEST(Report, SaysWhatTheFlightWasFlownWith) {
  const FlightRecord record = short_flight();
  const nlohmann::json flight =
      data_in(report_page(record, audit::audit_flight(record), {"fly.sh --count 40"}))["flight"];
  EXPECT_EQ(flight["command"], "fly.sh --count 40");
  EXPECT_FALSE(flight["version"].get<std::string>().empty());
  std::map<std::string, std::string> settings;
  for (const auto& words : flight["settings"]) settings[words[0]] = words[1];
  EXPECT_EQ(settings["seed"], "1");
  EXPECT_EQ(settings["count"], "40");
  EXPECT_EQ(settings["λ away"], "2");
  EXPECT_EQ(settings["v_max"], "[6, 6, 6]");
}

TEST(Report, OfAPacedFlightHasTheDateAtWhichItWasFlown) {
  FlightRecord record;
  constexpr std::int64_t kFlownUs = 1'795'521'600'000'000;  // 2026-11-24 12:00 UTC
  constexpr double kPace = 0.25;
  // The clocks at that pace show it so.
  record.contents.first_us = WallClock::kPaceOriginUs + (kFlownUs - WallClock::kPaceOriginUs) / 4;
  EXPECT_EQ(data_in(report_page(record, Audit{}, {"", kPace}))["flight"]["recorded_us"], kFlownUs);
  EXPECT_EQ(data_in(report_page(record, Audit{}))["flight"]["recorded_us"], record.contents.first_us);
}

TEST(FlownPace, IsWhatTheFlightsFolderSays) {
  const TempFolder folder;
  const std::string log = folder.file("flight.lcm");
  EXPECT_EQ(audit::flown_pace(log), 1.0);
  for (const auto& [line, pace] :
       std::map<std::string, double>{{"export LCM_DEFAULT_URL='udpm://' TERN_PACE=0.25", 0.25},
                                     {"export TERN_PACE=1", 1.0},
                                     {"export TERN_PACE=7", 1.0},
                                     {"export TERN_PACE=", 1.0}}) {
    std::ofstream(folder.file("env.sh")) << line << '\n';
    EXPECT_EQ(audit::flown_pace(log), pace) << line;
  }
}

TEST(Setting, IsReadWhereItsSectionIs) {
  const std::string yaml = "seed: 7\nworld:\n  name: a\n  box:\n    min: [1, 2]\n  count: 3\nuav:\n  count: 5\n";
  EXPECT_EQ(setting(yaml, "seed"), "7");
  EXPECT_EQ(setting(yaml, "world.box.min"), "[1, 2]");
  EXPECT_EQ(setting(yaml, "world.count"), "3");
  EXPECT_EQ(setting(yaml, "uav.count"), "5");
  EXPECT_EQ(setting(yaml, "uav.box.min"), "");
  EXPECT_EQ(setting(yaml, "world.see"), "");
}

TEST(Report, TellsWhatTheLogTells) {
  const FlightRecord record = short_flight();
  const Audit audit = audit::audit_flight(record);
  const nlohmann::json data = data_in(report_page(record, audit));
  EXPECT_EQ(data["flight"]["scenario"], "corridor_demo");
  EXPECT_EQ(data["flight"]["result"]["outcome"], "reached");
  EXPECT_EQ(data["path"]["t"].size(), record.states.size());
  EXPECT_EQ(data["path"]["share"], 1);
  EXPECT_EQ(data["answers"]["t"].size(), record.requests.size());
  EXPECT_EQ(data["obstacles"]["movers"].size() + data["obstacles"]["statics"].size(), 40U);
  EXPECT_EQ(data["regions"][0]["name"], "mural");
  EXPECT_EQ(data["audit"]["verdict"], "held");
  EXPECT_EQ(data["audit"]["checks"].size(), audit.checks.size());
  const double inside = audit.check("exposure").measures[1].second;
  EXPECT_GT(inside, 1.0);
  EXPECT_NEAR(data["path"]["exposure"][0].back().get<double>(), inside, 0.2) << "metres inside the mural";
}

TEST(Report, TellsWhereTheVehicleWasInItsTube) {
  FlightRecord record = short_flight();
  for (HorizonRequest& request : record.requests) request.tube = Vec3::Constant(0.3);
  const std::size_t k = record.states.size() / 2;
  record.states[k].motion.p.y() += 0.2;
  const nlohmann::json path = data_in(report_page(record, audit::audit_flight(record)))["path"];
  EXPECT_NEAR(path["off"][k].get<double>(), 0.2, 0.002);
  EXPECT_EQ(path["tube"][k], 0.3);
  EXPECT_LT(path["off"][k - 1].get<double>(), 0.002);
  EXPECT_TRUE(path["tube"][0].is_null()) << "nothing is promised yet";
}

/// Five minutes among 300 movers, at the rates of a live flight.
FlightRecord long_flight(int answers = 6'000) {
  FlightRecord record;
  for (int k = 0; k < 30'000; ++k) {
    UavState s;
    s.at = UTime{k * 10'000LL};
    s.motion.p = {0.037123 * k, 3.0 * std::sin(0.00123 * k), 1.0 + 0.5 * std::cos(0.00321 * k)};
    s.motion.v = {3.7123, 0.369 * std::cos(0.00123 * k), 0.1};
    s.motion.a = {0.01 * (k % 977), 0.0, 0.0};
    record.states.push_back(s);
  }
  record.states[12'345].motion.v.x() = 5.75;
  for (int id = 0; id < 300; ++id) {
    auto& history = record.truth[id];
    history.moves = true;
    for (int k = 0; k < 9'000; ++k) {
      history.samples.push_back({UTime{k * 33'333LL}, Vec3(4.0 * id + std::sin(0.01234 * k), std::cos(0.0321 * k), 1.0),
                                 Vec3::Zero(), Vec3::Constant(0.4)});
    }
  }
  for (int k = 1; k <= answers; ++k) {
    HorizonRequest request;
    request.header = {{1, k}, UTime{k * 50'000LL}};
    request.id = k;
    request.deadline = request.header.utime + Duration{70'000};
    record.requests.push_back(request);
    Plan plan;
    plan.header.name = {3, k};
    plan.request_id = k;
    plan.inputs.request = request.header.name;
    record.plans.push_back(plan);
    PlanTiming timing;
    timing.header.name = plan.header.name;
    timing.request_id = k;
    timing.total_ms = 1.234567 + 0.01 * (k % 331);
    for (double& ms : timing.stage_ms) ms = 0.123456 * (k % 13);
    record.timings.push_back(timing);
  }
  return record;
}

TEST(Report, OfASlowedFlightHasDeadlinesAndAnswerTimesOnOneScale) {
  FlightRecord record = long_flight();
  for (const double pace : {1.0, 0.5}) {
    const nlohmann::json answers = data_in(report_page(record, Audit{}, {.pace = pace}))["answers"];
    EXPECT_NEAR(answers["deadline"][0], 70.0 / pace, 1e-9) << "by the system's clock, as PLAN_TIMING";
    EXPECT_NEAR(answers["total"][0], record.timings.front().total_ms, 1e-3);
  }
}

TEST(Report, OfFiveMinutesAmong300MoversStaysUnder5MegabytesAndHidesNoExtreme) {
  const FlightRecord record = long_flight();
  Audit audit;
  for (const UavState& s : record.states)
    audit.clearance.push_back({s.at, 1.0 + 1e-5 * static_cast<double>(s.at.us % 977), 7});
  audit.clearance[23'456].clearance_m = 0.0625;
  const std::string page = report_page(record, audit);
  RecordProperty("bytes", std::to_string(page.size()));
  EXPECT_LT(page.size(), 5'000'000U);
  const nlohmann::json path = data_in(page)["path"];
  EXPECT_LE(path["t"].size(), kMaxPathPoints);
  EXPECT_GT(path["t"].size(), kMaxPathPoints / 2);
  const auto axis_speed = path["axis_speed"].get<std::vector<double>>();
  const auto clearance = path["clearance"].get<std::vector<double>>();
  EXPECT_DOUBLE_EQ(*std::max_element(axis_speed.begin(), axis_speed.end()), 5.75);
  EXPECT_NEAR(*std::min_element(clearance.begin(), clearance.end()), 0.0625, 1e-3);
}

TEST(Report, CountsEveryAnswerAlsoOfAFlightWhoseChartLeavesSomeOut) {
  FlightRecord record = long_flight(6'365);
  for (std::size_t k = 0; k < 100; ++k) record.timings[k].from_watchdog = true;
  for (std::size_t k = 0; k < 40; ++k) record.plans[k].outcome = PlanOutcome::Optimized;
  record.plans.resize(6'360);
  const nlohmann::json answers = report_data(record, Audit{})["answers"];
  EXPECT_LT(answers["t"].size(), 6'000U);
  const nlohmann::json& counts = answers["counts"];
  EXPECT_EQ(counts["requests"], 6'365);
  EXPECT_EQ(counts["from_watchdog"], 100);
  std::map<int, int> by_outcome;
  for (const auto& row : counts["outcomes"]) {
    by_outcome[row["outcome"].is_null() ? -1 : row["outcome"].get<int>()] += row["answers"].get<int>();
  }
  const std::map<int, int> expected{
      {-1, 5}, {static_cast<int>(Plan{}.outcome), 6'320}, {static_cast<int>(PlanOutcome::Optimized), 40}};
  EXPECT_EQ(by_outcome, expected);
}

TEST(Report, GivesTheAnswersOfARestartedExecutorTheirOwnTimings) {
  FlightRecord record = long_flight(10);
  const FlightRecord first = record;
  for (std::size_t k = 0; k < 10; ++k) {
    HorizonRequest request = first.requests[k];
    request.header = {{2, request.id}, request.header.utime + Duration{10'000'000}};
    record.requests.push_back(request);
    Plan plan = first.plans[k];
    plan.header.name.sequence += 10;
    plan.inputs.request = request.header.name;
    record.plans.push_back(plan);
    PlanTiming timing = first.timings[k];
    timing.header.name = plan.header.name;
    timing.total_ms += 100.0;
    record.timings.push_back(timing);
  }
  const nlohmann::json total = report_data(record, Audit{})["answers"]["total"];
  for (std::size_t k = 0; k < 10; ++k) {
    EXPECT_NEAR(total[k].get<double>(), first.timings[k].total_ms, 1e-3);
    EXPECT_NEAR(total[k + 10].get<double>(), first.timings[k].total_ms + 100.0, 1e-3);
  }
}

/// The error is along the short axis of the stated ellipsoid, so shorter than the bound that the chart draws.
TEST(Report, HasTheSummarysShareOfTimeWithinTheStatedEllipsoid) {
  FlightRecord record;
  for (int k = 0; k <= 400; ++k) {
    UavState state;
    state.at = UTime{k * 10'000LL};
    if (k >= 200) state.motion.v.x() = 1.0;
    state.motion.p.x() = k >= 200 ? 0.01 * (k - 200) : 0.0;
    record.states.push_back(state);
    Odometry odometry;
    odometry.at = state.at;
    odometry.state = EstimatorState::Tracking;
    odometry.p_OB = state.motion.p;
    odometry.p_OB.z() += k < 200 || k % 4 == 0 ? 0.4 : 0.3;  // at rest it does not count
    const std::array<double, 3> variances{1.0, 1.0, 0.01};
    for (std::size_t axis = 0; axis < 3; ++axis) odometry.pose_covariance[7 * axis] = variances[axis];
    record.odometry.push_back(odometry);
  }
  const nlohmann::json estimate = report_data(record, Audit{})["estimate"];
  EXPECT_NEAR(estimate["inside"].get<double>(), 0.75, 0.01);
  EXPECT_LT(estimate["error"][0].get<double>(), estimate["bound"][0].get<double>());
}

TEST(Report, HasThePercentilesOfTheMonitorsSummary) {
  const FlightRecord record = long_flight();  // one answer in 13 ran no stage
  const nlohmann::json costs = report_data(record, Audit{})["costs"];
  Scenario scenario;
  FlightWatch watch(scenario, UTime{});
  for (const PlanTiming& t : record.timings) watch.receive(t);
  const ReplanTimes times = watch.summary({}).replan_ms;
  const std::pair<const char*, Percentiles> rows[] = {{"whole answer", times.total},
                                                      {"broad phase", times.hulls},
                                                      {"search", times.search},
                                                      {"optimization", times.optimization},
                                                      {"check", times.check}};
  for (const auto& [name, p] : rows) {
    const auto row = std::find_if(costs.begin(), costs.end(), [n = name](const auto& c) { return c["name"] == n; });
    ASSERT_NE(row, costs.end()) << name;
    const auto ms = (*row)["ms"].get<std::vector<double>>();
    const double expected[] = {p.p50, p.p95, p.p99, p.max};
    ASSERT_EQ(ms.size(), std::size(expected));
    for (std::size_t k = 0; k < ms.size(); ++k) EXPECT_NEAR(ms[k], expected[k], 5.1e-4) << name << " " << k;
  }
}

TEST(Report, LetsNoTextOfALogBecomeMarkup) {
  FlightRecord record;
  record.path = "</script><script>alert(1)</script><!--";
  FlightResult result;
  result.detail = "touched <b>obstacle</b>\n\xff";
  record.results.push_back(result);
  const std::string page = report_page(record, Audit{});
  EXPECT_THAT(page, Not(HasSubstr("<script>alert")));
  EXPECT_THAT(page, Not(HasSubstr("<b>obstacle")));
  EXPECT_EQ(data_in(page)["flight"]["log"], record.path);
}

}  // namespace
}  // namespace tern::report
