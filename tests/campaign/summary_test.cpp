#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "campaign/records/campaign_summary.h"
#include "tests/campaign/some_flights.h"

namespace tern {
namespace {

Flights thirty_flights() {
  Flights flights;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    flights.records[seed] = some_flight(seed);
    flights.times[seed] = some_times(seed);
  }
  return flights;
}

TEST(CampaignSummary, CountsOutcomesAndNamesTheFailedSeeds) {
  const CampaignSummary s = summarize(thirty_flights());
  EXPECT_EQ(s.flights, 30);
  EXPECT_EQ(s.reached, 20);
  EXPECT_EQ(s.collisions, 10);
  EXPECT_EQ(s.successes, 20);
  EXPECT_EQ(s.failed_seeds, (std::vector<std::uint64_t>{3, 6, 9, 12, 15, 18, 21, 24, 27, 30}));
  EXPECT_EQ(s.deadlines_missed, 30);
  EXPECT_EQ(s.stops, 15);
  EXPECT_EQ(s.flight_time_s.count, 20) << "of the flights that reached";
  EXPECT_EQ(s.min_clearance_m.count, 30) << "of all";
  EXPECT_LT(s.min_clearance_m.min, 0.0);
}

TEST(CampaignSummary, TimesAreOverAllAnswers) {
  const CampaignSummary s = summarize(thirty_flights());
  EXPECT_EQ(s.times[0].count, 3000);
  EXPECT_EQ(s.times[0].max, 750.0);
  EXPECT_EQ(s.times[0].min, 0.25);
  EXPECT_EQ(s.times[1].count, 0);
}

TEST(CampaignSummary, SumsPromisesAndClaimsOverFlights) {
  const CampaignSummary s = summarize(thirty_flights());
  ASSERT_EQ(s.coverage.size(), 6U) << "a class with one horizon and five confidences; the plans of one";
  EXPECT_EQ(s.coverage[0].made, 3000);
  EXPECT_EQ(s.coverage[0].covered, 2940);
  EXPECT_EQ(s.coverage[0].groups, 30);
  EXPECT_NEAR(s.coverage[0].half_m, 0.125, 1e-12);
  EXPECT_TRUE(s.coverage[0].is_refuted()) << "0.98 in each of thirty flights is not 0.99";
  EXPECT_FALSE(s.coverage[1].is_refuted());
  EXPECT_EQ(s.coverage[5].what, kPlans);
  EXPECT_EQ(s.coverage[5].made, 300);
  const auto json = nlohmann::json::parse(to_json(s, ""));
  EXPECT_EQ(json["coverage"].size(), 6U);
  EXPECT_EQ(json["coverage"][0]["broken"], true);
}

TEST(CampaignSummary, SaysHowTheVehicleFollowedOfAuditedFlights) {
  Flights flights = thirty_flights();
  flights.records[7].tracking = {};
  const CampaignSummary s = summarize(flights);
  EXPECT_EQ(s.tracking_rmse_m.count, 29);
  EXPECT_EQ(s.tube_m.max, 0.25);
  EXPECT_NEAR(s.tube_margin_m.min, 0.1 / 30.0, 1e-12);
}

TEST(CampaignSummary, ALimitBrokenIsNoSuccess) {
  Flights flights;
  flights.records[1] = some_flight(1);
  flights.records[1].result.limit_violations = 1;
  const CampaignSummary s = summarize(flights);
  EXPECT_EQ(s.reached, 1);
  EXPECT_EQ(s.successes, 0);
  EXPECT_EQ(s.failed_seeds, std::vector<std::uint64_t>{1});
}

TEST(CampaignSummary, SaysTheClearanceOfObstaclesAndOfTheMap) {
  Flights flights = thirty_flights();
  for (auto& [seed, record] : flights.records) {
    record.result.min_map_clearance_m = seed % 2 == 0 ? std::nan("") : 0.032 * static_cast<double>(seed);
  }
  const CampaignSummary s = summarize(flights);
  EXPECT_EQ(s.min_map_clearance_m.count, 15) << "of flights that have a map";
  EXPECT_NEAR(s.min_map_clearance_m.min, 0.032, 1e-12);
  const auto json = nlohmann::json::parse(to_json(s, ""));
  EXPECT_NEAR(json["min_map_clearance_m"]["min"].get<double>(), 0.032, 1e-9);
  EXPECT_NE(to_text(s).find("min_map_clearance_m"), std::string::npos);
}

TEST(CampaignSummary, AsJsonHasEveryKeyAndNullForWhatIsUnknown) {
  const auto json = nlohmann::json::parse(to_json(summarize(thirty_flights()), "tern-campaign --world x"));
  for (const char* key : {"flights",       "reached",         "collisions",    "timeouts",        "failed",
                          "success",       "success_ci95",    "flight_time_s", "first_entry_s",   "mean_speed_mps",
                          "top_speed_mps", "min_clearance_m", "jerk_integral", "stops",           "limit_violations",
                          "replan_ms",     "first_answer_ms", "search_ms",     "optimization_ms", "deadlines_missed",
                          "exposure",      "failed_seeds",    "configuration", "version",         "compiler",
                          "machine",       "command"}) {
    EXPECT_TRUE(json.contains(key)) << key;
  }
  for (const char* key : {"mean", "p50", "p95", "p99", "min", "max"}) {
    EXPECT_TRUE(json["flight_time_s"].contains(key)) << key;
  }
  EXPECT_NEAR(json["success"].get<double>(), 2.0 / 3.0, 1e-12);
  EXPECT_TRUE(json["search_ms"]["p50"].is_null());
  EXPECT_NEAR(json["exposure"]["a \"pond\", wet"]["metres"]["max"].get<double>(), 30.0 / 9.0, 1e-6);
}

TEST(CampaignSummary, NoFlightsHaveNoRate) {
  const auto json = nlohmann::json::parse(to_json(summarize({}), ""));
  EXPECT_TRUE(json["success"].is_null());
  EXPECT_EQ(json["success_ci95"][0], 0.0);
  EXPECT_EQ(json["success_ci95"][1], 1.0);
}

TEST(CampaignSummary, CountsContactsInFlightApartFromThoseAtRest) {
  Flights flights = thirty_flights();
  for (auto& [seed, record] : flights.records) {
    (seed % 2 == 0 ? record.result.contacts_moving : record.result.contacts_at_rest) = seed % 3 == 0 ? 1 : 0;
  }
  const CampaignSummary s = summarize(flights);
  EXPECT_EQ(s.contacts_moving, 5);
  EXPECT_EQ(s.contacts_at_rest, 5);
  EXPECT_NE(to_text(s).find("collisions 10 (5 while moving, 5 at rest)"), std::string::npos) << to_text(s);
}

TEST(CampaignSummary, OfOneFlightFlownOftenHasNoInterval) {
  Flights flights;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    flights.records[seed] = some_flight(1);
    flights.records[seed].seed = seed;
  }
  const CampaignSummary s = summarize(flights);
  EXPECT_EQ(s.different, 1);
  EXPECT_FALSE(s.success_ci95);
  EXPECT_NE(to_text(s).find("no interval: they are 1 different flights"), std::string::npos) << to_text(s);
}

TEST(CampaignSummary, SaysHowManyWereNotAudited) {
  Flights flights = thirty_flights();
  EXPECT_EQ(to_text(summarize(flights)).find("audited"), std::string::npos);
  for (std::uint64_t seed = 1; seed <= 8; ++seed) flights.records[seed].audit = seed == 2 ? "broken" : "passed";
  const std::string text = to_text(summarize(flights));
  EXPECT_NE(text.find("audited 8 of 30, 1 broken, 7 passed"), std::string::npos) << text;
  EXPECT_NE(text.find("22 were flown earlier without --audit"), std::string::npos) << text;
}

}  // namespace
}  // namespace tern
