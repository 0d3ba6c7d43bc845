#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "monitor/flight_summary.h"

namespace tern {
namespace {

using nlohmann::json;

std::vector<std::string> keys(const json& object) {
  std::vector<std::string> names;
  for (const auto& [name, value] : object.items()) names.push_back(name);
  return names;
}

FlightSummary flown() {
  FlightSummary s;
  s.outcome = FlightOutcome::Reached;
  s.scenario = "corridor_demo";
  s.seed = 1;
  s.count = 100;
  s.settings = {Limits{}, 2.0, 3.0};
  s.command = "fly.sh --seed 1";
  FlightResult r;
  r.flight_time_s = 13.25;
  r.first_entry_s = std::numeric_limits<double>::quiet_NaN();
  r.min_clearance_m = -0.5;
  r.stops = 2;
  r.exposure = {{"mural", 1.5, 6.0, 2.0, 8.0}};
  s.result = r;
  s.requests = 300;
  s.answered_in_time = 299;
  s.second_answers = 140;
  s.plans = {250, 30, 15, 4, 1};
  s.replan_ms.total = {4.0, 10.0, 12.0, 20.0};
  s.messages["PLAN"] = {300, 2, 1};
  s.restarts = 3;
  s.log = "flight.lcm";
  s.version = "0.1.0+abc";
  return s;
}

TEST(Summary, HasExactlyTheKeysThatWerePromised) {
  const json summary = json::parse(to_json(flown()));
  EXPECT_THAT(keys(summary),
              testing::UnorderedElementsAre(
                  "outcome", "detail", "cause", "why", "recording", "scenario", "seed", "count", "settings",
                  "flight_time_s", "first_entry_s", "path_length_m", "mean_speed_mps", "top_speed_mps", "stops",
                  "min_clearance_m", "min_map_clearance_m", "limit_violations", "contacts_moving", "contacts_at_rest",
                  "obstacles", "obstacles_left_out", "requests", "answered_in_time", "second_answers", "plans",
                  "confidence", "left_out", "passively_safe_share", "replan_ms", "exposure", "messages", "restarts",
                  "said", "beside", "log", "command", "pace", "version"));
  EXPECT_THAT(keys(summary["settings"]),
              testing::UnorderedElementsAre("lambda_attractive", "lambda_repulsive", "v_max", "a_max", "j_max"));
  EXPECT_THAT(keys(summary["replan_ms"]),
              testing::UnorderedElementsAre("total", "first_answer", "hulls", "search", "optimization", "check"));
  EXPECT_THAT(keys(summary["replan_ms"]["hulls"]), testing::UnorderedElementsAre("p50", "p95", "p99", "max"));
  EXPECT_THAT(keys(summary["exposure"]["mural"]), testing::UnorderedElementsAre("seconds", "metres"));
  EXPECT_THAT(keys(summary["messages"]["PLAN"]), testing::UnorderedElementsAre("received", "rejected", "lost"));
}

TEST(Summary, SaysTheValuesInJson) {
  const json summary = json::parse(to_json(flown()));
  EXPECT_EQ(summary["outcome"], "reached");
  EXPECT_EQ(summary["seed"], 1);
  EXPECT_EQ(summary["flight_time_s"], 13.25);
  EXPECT_EQ(summary["stops"], 2);
  EXPECT_EQ(summary["settings"]["lambda_repulsive"], 3.0);
  EXPECT_EQ(summary["command"], "fly.sh --seed 1");
  EXPECT_EQ(summary["plans"]["optimized"], 250);
  EXPECT_EQ(summary["plans"]["no_plan"], 1);
  EXPECT_EQ(summary["replan_ms"]["total"]["p99"], 12.0);
  EXPECT_EQ(summary["messages"]["PLAN"]["lost"], 1);
}

TEST(Summary, WhatHasNoValueIsNull) {
  FlightSummary s = flown();
  EXPECT_TRUE(json::parse(to_json(s))["first_entry_s"].is_null());
  EXPECT_TRUE(json::parse(to_json(s))["replan_ms"]["search"]["p50"].is_null());
  s.result.reset();
  s.seed.reset();
  s.count.reset();
  const json unjudged = json::parse(to_json(s));
  EXPECT_TRUE(unjudged["flight_time_s"].is_null());
  EXPECT_TRUE(unjudged["stops"].is_null());
  EXPECT_TRUE(unjudged["seed"].is_null());
  EXPECT_TRUE(unjudged["count"].is_null());
  EXPECT_EQ(unjudged["exposure"], json::object());
}

TEST(Summary, SaysThatWallsComeFromAMap) {
  FlightSummary s = flown();
  s.result->obstacles = 0;
  s.result->min_map_clearance_m = 0.032;
  EXPECT_THAT(to_text(s), testing::HasSubstr("0 obstacles and a map's walls\n"));
  s.result->min_map_clearance_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(to_text(s), testing::HasSubstr("0 obstacles\n"));
}

TEST(Summary, RepeatsWhatReadyProcessesSay) {
  FlightSummary s = flown();
  s.said["tern-mapper"] = "a.ply: coordinates are rounded";
  EXPECT_THAT(to_text(s), testing::HasSubstr("  said          tern-mapper: a.ply: coordinates are rounded\n"));
  EXPECT_EQ(json::parse(to_json(s))["said"]["tern-mapper"], "a.ply: coordinates are rounded");
}

TEST(Summary, SaysTheShareThatWasCertifiedAgainstUnseenMovers) {
  FlightSummary s = flown();
  EXPECT_TRUE(json::parse(to_json(s))["passively_safe_share"].is_null());
  EXPECT_THAT(to_text(s), testing::Not(testing::HasSubstr("unseen")));
  s.passively_safe_share = 0.9731;
  EXPECT_EQ(json::parse(to_json(s))["passively_safe_share"], 0.9731);
  EXPECT_THAT(to_text(s), testing::HasSubstr("  unseen movers 97.3 % of the time certified\n"));
}

TEST(Summary, KeepsTheRangeOfASeed) {
  FlightSummary s = flown();
  s.seed = std::numeric_limits<std::uint64_t>::max();
  EXPECT_EQ(json::parse(to_json(s))["seed"], std::numeric_limits<std::uint64_t>::max());
}

TEST(Summary, FitsOneScreen) {
  FlightSummary s = flown();
  s.result->exposure.assign(6, s.result->exposure.front());
  for (int i = 0; i < 14; ++i) s.messages["CHANNEL_" + std::to_string(i)] = {1, 1, 1};
  s.reasons.fill(99);
  s.left_out = {99'999, 99'999};
  s.by_level.fill(99'999);
  s.for_a_time = 99'999;
  s.passively_safe_share = 1.0;
  std::istringstream text(to_text(s));
  int lines = 0;
  for (std::string line; std::getline(text, line); ++lines) EXPECT_LE(line.size(), 100U) << line;
  EXPECT_LE(lines, 35);
}

TEST(Summary, SaysThatPlansRestedOnAnIncompleteSet) {
  FlightSummary s = flown();
  EXPECT_EQ(to_text(s).find("left out"), std::string::npos);
  EXPECT_EQ(json::parse(to_json(s))["left_out"], (json{{"plans", 0}, {"most_tracks", 0}}));
  s.left_out = {130, 12};
  EXPECT_NE(to_text(s).find("130 plans rest on incomplete predictions: up to 12 tracks are not in them"),
            std::string::npos);
  EXPECT_EQ(json::parse(to_json(s))["left_out"], (json{{"plans", 130}, {"most_tracks", 12}}));
}

TEST(Summary, SaysHowManyPlansWereLessSureThanPromised) {
  FlightSummary s = flown();
  s.by_level = {200, 0, 0, 0, 0, 0};
  EXPECT_EQ(to_text(s).find("confidence"), std::string::npos);
  s.by_level = {200, 10, 9, 8, 7, 6};
  s.for_a_time = 5;
  EXPECT_NE(to_text(s).find("200 at full confidence, 34 at less, 6 below 0.6; 5 for a limited time"),
            std::string::npos);
  EXPECT_EQ(
      json::parse(to_json(s))["confidence"],
      (json{{"promised", 200}, {"0.95", 10}, {"0.9", 9}, {"0.8", 8}, {"0.6", 7}, {"for_a_time", 5}, {"below", 6}}));
}

TEST(Summary, SaysWhyBelowTheOutcome) {
  FlightSummary s = flown();
  s.outcome = FlightOutcome::Timeout;
  s.detail = "9 m from the goal";
  s.explanation = {Cause::StaleWorld,
                   "stood since 4.0 s: 160 answers *stale world*, sensor 0.28 s late, limit 0.3: a "
                   "faster sensor or a larger planner.stale_after_s would help"};
  EXPECT_THAT(to_text(s),
              testing::StartsWith(
                  "timeout: 9 m from the goal\n"
                  "  why           stood since 4.0 s: 160 answers *stale world*, sensor 0.28 s late, limit 0.3: a\n"
                  "                faster sensor or a larger planner.stale_after_s would help\n"));
  const json summary = json::parse(to_json(s));
  EXPECT_EQ(summary["cause"], "stale world");
  EXPECT_EQ(summary["why"], s.explanation.sentence);
}

TEST(Summary, OfAFlightThatReachedItsGoalAsBelievedBeginsWithThat) {
  FlightSummary s = flown();
  s.outcome = FlightOutcome::Timeout;
  s.detail = "reached as believed: 0.05 m from the goal by its own estimate, 0.52 m in truth";
  EXPECT_THAT(to_text(s), testing::StartsWith(s.detail + "\n"));
  EXPECT_EQ(exit_code(s), 2) << "it is not there in truth";
}

TEST(Summary, OfAnIncompleteRecordingSaysSoAndIsNoSuccess) {
  FlightSummary s = flown();
  EXPECT_TRUE(json::parse(to_json(s))["recording"].is_null()) << "no logger was heard";
  EXPECT_EQ(exit_code(s), 0);
  s.recording = "";
  EXPECT_EQ(json::parse(to_json(s))["recording"], "complete");
  EXPECT_EQ(exit_code(s), 0);
  EXPECT_THAT(to_text(s), Not(testing::HasSubstr("recording")));
  s.recording = "132 messages are not in the log: flight.lcm: No space left on device";
  EXPECT_EQ(json::parse(to_json(s))["recording"], "incomplete: " + *s.recording);
  EXPECT_EQ(exit_code(s), kExitIncomplete);
  EXPECT_THAT(to_text(s), testing::HasSubstr("  recording     incomplete: 132 messages are not in the log"));
  for (const FlightOutcome outcome : {FlightOutcome::Collision, FlightOutcome::Timeout, FlightOutcome::Failed}) {
    s.outcome = outcome;
    EXPECT_EQ(exit_code(s), static_cast<int>(outcome));
  }
}

TEST(Summary, OfASlowedFlightSaysByWhichClockReplanningIsMeasured) {
  FlightSummary s = flown();
  EXPECT_THAT(to_text(s), Not(testing::HasSubstr("pace")));
  s.pace = 0.5;
  EXPECT_THAT(to_text(s), testing::HasSubstr("max   by the system's clock, at a pace of 0.5\n"));
  EXPECT_EQ(json::parse(to_json(s))["pace"], 0.5);
}

TEST(Summary, TellsAPersonTheOutcomeFirst) {
  FlightSummary s = flown();
  s.outcome = FlightOutcome::Collision;
  s.detail = "hit obstacle 7";
  EXPECT_EQ(to_text(s).substr(0, 26), "collision: hit obstacle 7\n");
}

}  // namespace
}  // namespace tern
