// Missing, repeated and mixed messages of a log are listed and never called broken; the rest is still judged.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "messages/codec.h"
#include "tests/tools/audit_of_a_log.h"
#include "tools/audit/true_motion.h"

namespace tern::audit {
namespace {

using ::testing::Contains;
using testing::copy_log;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// Expects the same findings and numbers, whatever the file.
void expect_same(const Audit& a, const Audit& b) {
  ASSERT_EQ(a.checks.size(), b.checks.size());
  for (std::size_t k = 0; k < a.checks.size(); ++k) {
    EXPECT_EQ(a.checks[k].summary, b.checks[k].summary);
    EXPECT_EQ(a.checks[k].checked, b.checks[k].checked) << a.checks[k].name;
    EXPECT_EQ(a.checks[k].broken, b.checks[k].broken) << a.checks[k].name;
    EXPECT_EQ(a.checks[k].unchecked, b.checks[k].unchecked) << a.checks[k].name;
  }
  EXPECT_EQ(a.missing, b.missing);
}

TEST_F(AuditOfALog, WithoutStatesForASecondKnowsTheMotionByWhatWasCommitted) {
  const std::string log = with<UavState>(good(), channels::kVehicleTruth.name, [](const UavState& s) {
    return s.at.us < at_us(2.0) || s.at.us > at_us(3.0);
  });
  const Audit whole = audit(good());
  const Audit gap = audit(log);
  EXPECT_THAT(broken(gap), IsEmpty()) << text(gap);
  EXPECT_EQ(vehicle_motion(read_).hole_count, 0);
  EXPECT_NEAR(measure_of(gap, "result", "path_m_at_least"), measure_of(whole, "result", "path_m_at_least"), 1e-3);
  EXPECT_NEAR(measure_of(gap, "result", "path_m_at_most"), measure_of(whole, "result", "path_m_at_most"), 1e-3);
  EXPECT_EQ(gap.least.high, whole.least.high);
}

TEST_F(AuditOfALog, OfALoggerThatWasAwayBoundsWhatItMissedAndBreaksNothing) {
  const std::string log = another_file();
  testing::copy_log_without(good(), log, at_us(2.0), at_us(2.6));
  const Audit away = audit(log);
  EXPECT_THAT(broken(away), IsEmpty()) << text(away);
  const double path = record_->results.back().path_length_m;
  EXPECT_LT(measure_of(away, "result", "path_m_at_least"), path);
  EXPECT_GT(measure_of(away, "result", "path_m_at_most"), path);
  EXPECT_LT(measure_of(away, "result", "path_m_at_most"), path + 0.6 * 6.0 * std::sqrt(3.0));
  EXPECT_THAT(text(away), HasSubstr("s in holes"));
  EXPECT_THAT(text(away), Not(HasSubstr("Nothing was left unchecked")));
  EXPECT_EQ(away.verdict(), Verdict::Incomplete);
  EXPECT_THAT(away.span.gaps, ElementsAre(HasSubstr("1 times no state for more than 0.3 s")));
}

TEST_F(AuditOfALog, OfALoggerThatWasAwayStillFindsARefereeThatErrsByMoreThanTheGapExplains) {
  const std::string log = another_file();
  testing::copy_log_without(good(), log, at_us(2.0), at_us(2.6));
  const std::string lying = with<FlightResult>(log, channels::kFlightResult.name, [](FlightResult& r) {
    r.path_length_m += 6.0;
    return true;
  });
  EXPECT_THAT(broken(audit(lying)), ElementsAre("result"));
}

TEST_F(AuditOfALog, OfABusyMachineWithRareStatesBreaksNothing) {
  int k = 0;
  const std::string log =
      with<UavState>(good(), channels::kVehicleTruth.name, [&](const UavState&) { return ++k % 11 == 0; });
  EXPECT_THAT(broken(audit(log)), IsEmpty());
}

TEST_F(AuditOfALog, WithoutRequestsAndStatesInTurnBreaksNothing) {
  for (int phase = 0; phase < 3; ++phase) {
    int k = phase;
    const std::string log = another_file();
    copy_log(good(), log, [&](std::string_view channel, std::vector<std::uint8_t>& bytes) {
      if (channel != channels::kConfiguration.name && ++k % 3 == 0) bytes.clear();
    });
    const Audit lossy = audit(log);
    EXPECT_THAT(broken(lossy), IsEmpty()) << text(lossy);
  }
}

TEST_F(AuditOfALog, OfALoggerThatCameLateSaysSoAndBreaksNothing) {
  const std::string log = another_file();
  testing::copy_part_of_log(good(), log, at_us(2.0), INT64_MAX);
  const Audit late = audit(log);
  EXPECT_THAT(broken(late), IsEmpty()) << text(late);
  EXPECT_THAT(late.missing, Contains(HasSubstr("the log begins with request")));
  EXPECT_THAT(text(late), HasSubstr("lie before the log's first state or after its last"));
}

TEST_F(AuditOfALog, OfALoggerThatMissedTheFirstMapLacksNothingAsThatIsRepeated) {
  const auto after_the_first = [](const auto& m) { return m.header.name.sequence > 1; };
  const std::string log = with<MapChunk>(good(), channels::kSemanticMap.name, after_the_first);
  const Audit audited = audit(log);
  EXPECT_EQ(read_.contents.channels.at("SEMANTIC_MAP").before_first, 1);
  EXPECT_THAT(audited.missing, IsEmpty());
  EXPECT_THAT(audit(with<TrackSet>(log, channels::kPredictions.name, after_the_first)).missing,
              Contains(HasSubstr("PREDICTIONS: the log lacks the first")));
}

TEST_F(AuditOfALog, WithoutTheFirstRequestsDoesNotKnowWhatWasCommittedBefore) {
  const Audit audited = audit(
      with<HorizonRequest>(good(), channels::kHorizonRequest.name, [](const HorizonRequest& r) { return r.id > 4; }));
  EXPECT_THAT(broken(audited), IsEmpty()) << text(audited);
  EXPECT_EQ(audited.check("commitment").unchecked.count("setpoints from before the first request in the log"), 1U);
}

TEST_F(AuditOfALog, OfALoggerThatCameBackForTheLastSetpointsDoesNotKnowTheirRequest) {
  const std::string away = another_file();
  testing::copy_log_without(good(), away, at_us(2.0), at_us(3.2));
  const Audit audited = audit(with<HorizonRequest>(away, channels::kHorizonRequest.name,
                                                   [](const HorizonRequest& r) { return r.t_s.us < at_us(2.6); }));
  EXPECT_THAT(broken(audited), IsEmpty()) << text(audited);
  EXPECT_EQ(
      audited.check("commitment").unchecked.count("setpoints that may follow a trajectory whose requests were lost"),
      1U);
}

TEST_F(AuditOfALog, OfALoggerThatCameBackDoesNotMissAnAnswerOfItsSilence) {
  (void)audit(good());
  const auto asked = [](const HorizonRequest& r) { return r.header.utime.us < at_us(2.0); };
  const auto last = std::find_if(read_.requests.rbegin(), read_.requests.rend(), asked);
  ASSERT_NE(last, read_.requests.rend());
  const std::string away = another_file();
  testing::copy_log_without(good(), away, last->header.utime.us + 1'000, at_us(3.2));
  const Audit audited = audit(with<HorizonRequest>(
      with<Plan>(away, channels::kPlan.name, [](const Plan& p) { return p.header.utime.us < at_us(3.0); }),
      channels::kHorizonRequest.name, asked));
  EXPECT_THAT(broken(audited), IsEmpty()) << text(audited);
  EXPECT_EQ(audited.check("answers").unchecked.count("requests whose answer falls into a silence of the log"), 1U);
}

TEST_F(AuditOfALog, OfALoggerThatDiedBreaksNothing) {
  const std::string log = another_file();
  testing::copy_part_of_log(good(), log, 0, at_us(2.5));
  const Audit dead = audit(log);
  EXPECT_THAT(broken(dead), IsEmpty()) << text(dead);
  EXPECT_THAT(text(dead), HasSubstr("the flight has no FLIGHT_RESULT"));
}

TEST_F(AuditOfALog, FromANetworkThatDeliversEveryMessageTwiceIsTheSame) {
  const std::string twice = another_file();
  testing::copy_log_repeated(good(), twice, 2);
  const Audit once = audit(good());
  expect_same(once, audit(twice));
}

TEST_F(AuditOfALog, OfTwoPlannersCountsTheAnswersOfTheSecondAsSuch) {
  const std::string second = another_file(), both = another_file();
  copy_log(good(), second, [](std::string_view channel, std::vector<std::uint8_t>& bytes) {
    if (channel != channels::kPlan.name) return bytes.clear();
    auto plan = decode<Plan>(bytes).value();
    plan.header.name.sender_epoch_us += 17;
    bytes = encode(plan);
  });
  testing::join_logs({good(), second}, both);
  const Audit audited = audit(both);
  EXPECT_THAT(broken(audited), IsEmpty()) << text(audited);
  EXPECT_EQ(measure_of(audited, "answers", "second_answers"), static_cast<double>(record_->plans.size()));
  EXPECT_THAT(audited.check("answers").summary, HasSubstr("second answers by another planner"));
}

TEST_F(AuditOfALog, OfAPlannerThatAnswersTwiceIsBroken) {
  const std::string second = another_file(), both = another_file();
  copy_log(good(), second, [](std::string_view channel, std::vector<std::uint8_t>& bytes) {
    if (channel != channels::kPlan.name) return bytes.clear();
    auto plan = decode<Plan>(bytes).value();
    plan.header.name.sequence += 10'000;
    bytes = encode(plan);
  });
  testing::join_logs({good(), second}, both);
  EXPECT_THAT(broken(audit(both)), ElementsAre("answers"));
}

TEST_F(AuditOfALog, WithTheWorldOfARestartedSimulatorJudgesTheFirstFlightAndNamesTheOther) {
  const std::string other = another_file();
  testing::record_flight(TERN_SCENARIO_FOLDER "/corridor_demo.yaml",
                         {"world.count=60", "seed=7", "uav.goal=[24, 0, 1]", "executor.rate_hz=10"}, other,
                         record_->end() + Duration{500'000});
  const std::string first = another_file(), mixed = another_file();
  testing::copy_part_of_log(good(), first, 0, at_us(2.5));
  for (const std::string& log : {first, good()}) {
    testing::join_logs({log, other}, mixed);
    const Audit alone = audit(log);
    Audit both = audit(mixed);
    EXPECT_THAT(broken(both), IsEmpty()) << text(both);
    ASSERT_EQ(both.missing.size(), alone.missing.size() + 2) << "its simulator and its executor";
    EXPECT_THAT(both.missing.back(), HasSubstr("another flight"));
    EXPECT_THAT(text(both), HasSubstr("not audited"));
    for (const char* check : {"clearance", "limits", "commitment", "result"}) {
      EXPECT_EQ(alone.check(check).summary, both.check(check).summary);
      EXPECT_EQ(alone.check(check).checked, both.check(check).checked) << check;
    }
    std::remove(mixed.c_str());
  }
}

/// A simulator publishes its world while it waits. If it dies then, its successor's world is the one that is flown in.
TEST_F(AuditOfALog, WithAWorldThatEndedBeforeTheFlightJudgesTheWorldThatWasFlownIn) {
  const std::string waiting = another_file(), ghost = another_file(), both = another_file();
  testing::copy_part_of_log(good(), waiting, 0, record_->requests.front().header.utime.us);
  copy_log(waiting, ghost, [](std::string_view channel, std::vector<std::uint8_t>& bytes) {
    if (channel != channels::kObstacleTruth.name) return bytes.clear();
    auto truth = decode<ObstacleTruth>(bytes).value();
    truth.header.name.sender_epoch_us -= 17;
    bytes = encode(truth);
  });
  testing::join_logs({ghost, good()}, both);
  const Audit alone = audit(good());
  const Audit audited = audit(both);
  EXPECT_EQ(audited.verdict(), Verdict::Held) << text(audited);
  EXPECT_EQ(audited.check("clearance").summary, alone.check("clearance").summary);
  EXPECT_EQ(read_.requests.size(), record_->requests.size());
  EXPECT_THAT(audited.missing, ElementsAre(HasSubstr("has a world of its own, 0 requests: not audited")));
}

TEST_F(AuditOfALog, NamesAGoalThatPlansNameAndNobodyRecorded) {
  const Audit audited = audit(without<Goal>(channels::kGoal.name));
  EXPECT_THAT(audited.missing, Contains("no GOAL"));
  EXPECT_THAT(audited.missing, Contains(HasSubstr("not in the log")));
  const std::string log =
      with<Goal>(good(), channels::kGoal.name, [](const Goal& g) { return g.header.name.sequence != 2; });
  const Audit lost = audit(log);
  EXPECT_THAT(lost.missing, Contains(HasSubstr("GOAL: 2 messages lost")));
  EXPECT_THAT(text(lost), Not(HasSubstr("Nothing was left unchecked")));
  EXPECT_THAT(broken(lost), IsEmpty());
}

TEST_F(AuditOfALog, NamesAConfigurationThatTheLoggerMissed) {
  const std::uint64_t named = record_->plans.front().inputs.configuration_hash;
  const Audit audited = audit(with<ConfigurationReport>(
      good(), channels::kConfiguration.name, [named](const ConfigurationReport& r) { return r.hash != named; }));
  const std::string hash = [&] {
    std::ostringstream out;
    out << std::hex << named;
    return out.str();
  }();
  EXPECT_THAT(text(audited), Not(HasSubstr("Nothing was left unchecked")));
  EXPECT_THAT(audited.missing, Contains(HasSubstr(hash)));
  EXPECT_THAT(broken(audited), IsEmpty());
}

TEST_F(AuditOfALog, WithoutDeclaredMotionsStatesTheClearanceAtTheSamples) {
  const Audit audited = audit(without<TrackSet>(channels::kDeclaredMotions.name));
  EXPECT_THAT(broken(audited), IsEmpty());
  EXPECT_FALSE(audited.least.proven);
  EXPECT_THAT(audited.check("clearance").summary, HasSubstr("between samples by interpolation"));
  EXPECT_THAT(text(audited), HasSubstr("their motion was not declared"));
}

std::string colliding(FlightResult& r) {
  r.outcome = FlightOutcome::Collision;
  r.detail = "touched obstacle 3";
  return r.detail;
}

TEST_F(AuditOfALog, OfACollisionThatItCannotTellSaysSoInTheVerdict) {
  const std::string undeclared = without<TrackSet>(channels::kDeclaredMotions.name);
  const std::string log = with<FlightResult>(undeclared, channels::kFlightResult.name, [](FlightResult& r) {
    colliding(r);
    return true;
  });
  const Audit audited = audit(log);
  EXPECT_EQ(audited.collision, Collision::CannotTell);
  EXPECT_THAT(broken(audited), IsEmpty());
  EXPECT_THAT(text(audited), HasSubstr("held, but the referee saw a collision: too close to tell from the log\n"));
  EXPECT_EQ(to_json(audited, read_)["collision"], "cannot tell");
  EXPECT_EQ(run_program(log), 0) << "nothing that was recomputed is broken";
}

TEST_F(AuditOfALog, OfACollisionThatTheLogContradictsIsBroken) {
  const std::string far = with<HorizonRequest>(good(), channels::kHorizonRequest.name, [](HorizonRequest& r) {
    r.body.radius = 1e-6;  ///< so small a body surely passed clear
    return true;
  });
  const std::string log = with<FlightResult>(far, channels::kFlightResult.name, [](FlightResult& r) {
    colliding(r);
    return true;
  });
  const Audit audited = audit(log);
  EXPECT_EQ(audited.collision, Collision::Contradicts);
  EXPECT_THAT(text(audited), HasSubstr("BROKEN: the referee saw a collision, but the log contradicts it\n"));
  EXPECT_EQ(run_program(log), 1);
}

TEST(AuditOfAFastVehicle, Holds) {
  const TempFolder folder;
  const std::string log = folder.file("fast.lcm");
  testing::record_flight(TERN_SCENARIO_FOLDER "/corridor_demo.yaml",
                         {"world.count=5", "uav.limits.v_max=100", "uav.limits.a_max=1000"}, log);
  const FlightRecord record = load_flight(log).value();
  EXPECT_GT(record.results.back().top_speed_mps, 20.0);
  const Audit audit = audit_flight(record);
  for (const Check& check : audit.checks) EXPECT_NE(check.verdict(), Verdict::Broken) << to_text(audit, record);
}

}  // namespace
}  // namespace tern::audit
