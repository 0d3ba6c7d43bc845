#include "campaign/recorded_flight.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>

#include "flight_log/flight_log.h"
#include "messages/codec.h"
#include "runtime/config.h"
#include "tests/support/temp_folder.h"
#include "tools/audit/app/load_flight.h"
#include "tools/audit/audit.h"

namespace tern {
namespace {

FlightInputs short_hop(Charge charge, std::vector<std::string> overrides = {}) {
  return {TERN_SHORT_HOP, std::move(overrides), charge};
}

FlightRecord fly(const FlightInputs& inputs, std::uint64_t seed, const TempFolder& folder) {
  return fly_recorded(inputs, seed, check_inputs(inputs, seed), folder.file(""), {}).record;
}

TEST(RecordedFlight, ASpeltOutScenarioMakesTheSameFlight) {
  const TempFolder first, second;
  // Settings of processes are in the scenario as well; the flight ends by its timeout.
  const FlightInputs inputs = short_hop(Charge::Counts, {"timeout_s=1.0", "predictor.horizon_s=2.5"});
  const FlightRecord flown = fly(inputs, 5, first);
  EXPECT_EQ(flown.result.outcome, FlightOutcome::Timeout);
  const FlightInputs spelt_out{first.file("scenario.yaml"), {}, Charge::Counts};
  const FlightRecord again = fly(spelt_out, 5, second);
  EXPECT_EQ(again.result.outcome, FlightOutcome::Timeout);
  EXPECT_EQ(again.result.path_length_m, flown.result.path_length_m);
  EXPECT_EQ(again.result.min_clearance_m, flown.result.min_clearance_m);
  EXPECT_EQ(again.plans, flown.plans);
}

TEST(RecordedFlight, AMissionMayTakeLongerThanTheWayToTheScenariosGoal) {
  const TempFolder folder;
  const std::string mission = folder.file("mission.csv");
  std::ofstream(mission) << "x,y,z,hold_s\n1,0,1,80\n";
  const FlightInputs inputs =
      short_hop(Charge::Counts, {"world.count=0", "simulator.goals_from=tern-mission", "mission.file=" + mission});
  const FlightRecord flown = fly(inputs, 1, folder);
  EXPECT_EQ(flown.result.outcome, FlightOutcome::Reached) << flown.result.detail;
  EXPECT_GT(flown.result.flight_time_s, 80.0);
}

TEST(RecordedFlight, AFolderThatHoldsALogIsRefusedAndStaysAsItIs) {
  const TempFolder folder;
  std::ofstream(folder.file("flight.lcm")) << "of another flight";
  EXPECT_THROW(fly(short_hop(Charge::Counts), 1, folder), CannotRecord);
  const std::filesystem::directory_iterator files(folder.file(""));
  EXPECT_EQ(std::distance(begin(files), end(files)), 1);
}

TEST(RecordedFlight, TheLogHoldsEveryRequestWithItsAnswerInVirtualTime) {
  const TempFolder folder;
  const FlightRecord flown = fly(short_hop(Charge::Cpu), 1, folder);
  EXPECT_EQ(flown.result.outcome, FlightOutcome::Reached) << flown.result.detail;
  std::map<std::int64_t, int> answers;
  std::int64_t requests = 0;
  FlightLog log;
  log.on(channels::kHorizonRequest, [&](const HorizonRequest& r, std::int64_t received_us) {
    ++requests;
    EXPECT_EQ(received_us, r.header.utime.us);
  });
  log.on(channels::kPlan, [&](const Plan& plan, std::int64_t received_us) {
    ++answers[plan.request_id];
    EXPECT_EQ(received_us, plan.header.utime.us);
  });
  const auto contents = log.read(folder.file("flight.lcm"));
  ASSERT_TRUE(contents) << contents.error().message;
  EXPECT_EQ(contents->damage.bytes, 0);
  EXPECT_EQ(requests, flown.requests);
  EXPECT_EQ(static_cast<std::int64_t>(answers.size()), flown.requests);
  EXPECT_EQ(contents->channels.at("PLAN").lost, 0);
}

/// A flight that fails, and what a person must read of it.
struct Failed {
  std::vector<std::string> overrides;
  std::string cause, words;
};

TEST(RecordedFlight, OneSentenceSaysWhyInSummaryAndTableAndOfTheLog) {
  const std::string wall = "world.obstacles=[{name: gate, centre: [2, 0, 2], half_extents: [0.3, 8, 8]}]";
  const std::vector<Failed> flights{
      {{"timeout_s=1.0"}, "time too short", "was on its way"},
      {{"world.generator=none", "world.count=0", wall}, "goal blocked", "'gate'"},
      {{"uav.goal=[4, 2.5, 1]", "uav.body.radius=0.4", "executor.tube_m=0.3"},
       "goal blocked",
       "inside the box less a tube of 0.3 m"},
      {{"world.generator=none", "world.count=0",
        "world.obstacles=[{name: crate, centre: [0, 0, 1], half_extents: [1, 1, 1]}]"},
       "contact",
       "the start lies in obstacle 0 'crate'"},
  };
  for (const Failed& flight : flights) {
    const TempFolder folder;
    std::vector<std::string> overrides = flight.overrides;
    if (overrides.front() != "timeout_s=1.0") overrides.emplace_back("timeout_s=4.0");
    const FlightRecord flown = fly(short_hop(Charge::Counts, overrides), 1, folder);
    const auto summary = nlohmann::json::parse(std::ifstream(folder.file("summary.json")));
    EXPECT_EQ(summary["cause"], flight.cause) << summary["why"];
    EXPECT_NE(summary["why"].get<std::string>().find(flight.words), std::string::npos) << summary["why"];
    EXPECT_EQ(flown.result.detail, summary["why"]);
    EXPECT_EQ(audit::load_flight(folder.file("flight.lcm")).value().why, summary["why"]);
  }
}

TEST(RecordedFlight, AnAuditKeepsTheNamesOfObstacles) {
  const TempFolder folder;
  fly(short_hop(Charge::Counts,
                {"timeout_s=1.0", "world.obstacles=[{name: gate, centre: [2, 9, 2]}, {centre: [2, -9, 2]}]"}),
      1, folder);
  const audit::FlightRecord record = audit::load_flight(folder.file("flight.lcm")).value();
  EXPECT_EQ(record.name_of(3), "obstacle 3 'gate'") << "after the generator's three";
  EXPECT_EQ(record.name_of(4), "obstacle 4");
}

TEST(RecordedFlight, StatesTheShareOfTheTimeThatAnAuditFindsPassivelySafe) {
  const TempFolder folder;
  const FlightInputs inputs{
      TERN_SCENARIOS "/blind_corner.yaml",
      {"simulator.sensors=[{type: camera}, {type: lidar}]", "planner.unseen=passive", "timeout_s=12"},
      Charge::Counts};
  const FlightRecord flown = fly(inputs, 1, folder);
  const auto summary = nlohmann::json::parse(std::ifstream(folder.file("summary.json")));
  EXPECT_EQ(summary["passively_safe_share"], flown.passively_safe_share);
  const audit::Check audited = audit::check_unseen(audit::load_flight(folder.file("flight.lcm")).value());
  EXPECT_EQ(audited.measures.front().first, "passively_safe_share");
  const double share = audited.measures.front().second;
  EXPECT_NEAR(flown.passively_safe_share, share, 0.02);
  EXPECT_GT(share, 0.5);
  EXPECT_LT(share, 1.0) << "choose a flight that is not certified all the time";
}

TEST(RecordedFlight, WithUnseenMoversIgnoredNoShareIsStated) {
  const TempFolder folder;
  EXPECT_TRUE(std::isnan(fly(short_hop(Charge::Counts, {"timeout_s=0.5"}), 1, folder).passively_safe_share));
  EXPECT_TRUE(nlohmann::json::parse(std::ifstream(folder.file("summary.json")))["passively_safe_share"].is_null());
}

TEST(RecordedFlight, AnAuditKnowsTheNamesOfRecordedObstacles) {
  const TempFolder folder;
  const std::string people = folder.file("people.txt");
  std::ofstream(people) << "0 142 8 8\n100 142 9 9\n0 7 8 -8\n100 7 9 -9\n";
  fly(short_hop(Charge::Counts,
                {"timeout_s=0.5", "world.count=0", "world.obstacles=[]",
                 "world.recorded=[{file: " + people +
                     ", columns: 4, frame_column: 0, id_column: 1, x_column: 2, y_column: 3, "
                     "frames_per_second: 10, start_s: 0, half_extents: [0.3, 0.3, 0.9], centre_z: 0.9}]"}),
      1, folder);
  const auto record = audit::load_flight(folder.file("flight.lcm"));
  ASSERT_TRUE(record);
  EXPECT_EQ(record->obstacle_names, (std::map<std::int64_t, std::string>{{0, "people#7"}, {1, "people#142"}}));
}

TEST(RecordedFlight, OfARefusedMapLeavesNothingThatRefusesTheNextOne) {
  const TempFolder folder;
  EXPECT_THROW(fly(short_hop(Charge::Counts, {"mapper.sources=[{file: missing.ply}]"}), 1, folder), ConfigError);
  EXPECT_FALSE(std::filesystem::exists(folder.file("flight.lcm")));
}

TEST(RecordedFlight, AChargedPlanArrivesWhenItsCpuTimeIsOver) {
  const TempFolder folder;
  struct Watch final : FlightObserver {
    std::map<std::int64_t, UTime> asked;
    std::vector<double> latency_ms;
    void on_request(const HorizonRequest& r) override { asked[r.id] = r.header.utime; }
    void on_plan(const Plan& p) override {
      latency_ms.push_back((p.header.utime - asked.at(p.request_id)).seconds() * 1e3);
    }
  } watch;
  const FlightInputs inputs = short_hop(Charge::Cpu);
  const RecordedFlight flight = fly_recorded(inputs, 1, check_inputs(inputs, 1), folder.file(""), {}, &watch);
  const Distribution charged = describe(watch.latency_ms), measured = flight.times.times[0].describe();
  EXPECT_EQ(charged.count, measured.count);
  EXPECT_NEAR(charged.mean, measured.mean, 1e-6);
  EXPECT_NEAR(charged.max, measured.max, 1e-6);
  EXPECT_GT(charged.min, 0.0);
}

TEST(RecordedFlight, AChargedPlannerIsCutOrWatchedAndAnswersInTimeHoweverShortTheDeadline) {
  const TempFolder folder;
  // The deadline is 5 ms after the request and the watchdog 1 ms after it: less time than many plans need.
  const FlightRecord flown = fly(short_hop(Charge::Cpu, {"executor.lead_s=0.01", "timeout_s=2"}), 1, folder);
  EXPECT_GT(flown.requests, 20);
  EXPECT_EQ(flown.answered_in_time, flown.requests);
  EXPECT_EQ(flown.answers_late, 0);
  EXPECT_EQ(flown.answers_refused, 0);
}

TEST(RecordedFlight, ByCountsNothingMeasuredIsInItsLine) {
  const TempFolder first, second;
  const FlightInputs inputs = short_hop(Charge::Counts);
  EXPECT_EQ(to_cells(fly(inputs, 2, first)), to_cells(fly(inputs, 2, second)));
}

TEST(FlightInputs, IdentityKnowsEverySettingButTheSeed) {
  const CampaignIdentity plain = check_inputs(short_hop(Charge::Cpu), 1);
  EXPECT_EQ(plain, check_inputs(short_hop(Charge::Cpu), 2));
  EXPECT_NE(plain, check_inputs(short_hop(Charge::Counts), 1));
  EXPECT_NE(plain.configuration,
            check_inputs(short_hop(Charge::Cpu, {"planner.hold_required_s=0.7"}), 1).configuration);
  EXPECT_THROW(check_inputs(short_hop(Charge::Cpu, {"planner.hold=1"}), 1), ConfigError);
}

TEST(FlightInputs, AScenarioIsFoundByNameOrTheNamesAreListed) {
  EXPECT_TRUE(find_scenario("corridor_demo"));
  EXPECT_TRUE(find_scenario(TERN_SHORT_HOP));
  const auto missing = find_scenario("corridor_dem");
  ASSERT_FALSE(missing);
  EXPECT_NE(missing.error().message.find("corridor_demo"), std::string::npos);
}

}  // namespace
}  // namespace tern
