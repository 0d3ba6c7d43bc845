#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "campaign/records/campaign_comparison.h"
#include "core/base/random.h"
#include "tests/campaign/some_flights.h"

namespace tern {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

Flights flights_of(std::uint64_t first, std::uint64_t last) {
  Flights flights;
  for (std::uint64_t seed = first; seed <= last; ++seed) flights.records[seed] = some_flight(seed);
  return flights;
}

const ComparedMeasure& measure(const CampaignComparison& c, const std::string& name) {
  for (const ComparedMeasure& m : c.measures) {
    if (m.name == name) return m;
  }
  throw std::invalid_argument(name);
}

TEST(McNemar, IsTheBinomialsTwoTails) {
  EXPECT_EQ(mcnemar(0, 0), 1.0);
  EXPECT_EQ(mcnemar(3, 3), 1.0);
  EXPECT_NEAR(mcnemar(0, 5), 2.0 / 32.0, 1e-12);
  EXPECT_NEAR(mcnemar(1, 9), 2.0 * 11.0 / 1024.0, 1e-12);
  EXPECT_EQ(mcnemar(2, 11), mcnemar(11, 2));
  EXPECT_LT(mcnemar(100, 400), 1e-30);
}

TEST(PairedDifference, CoversTheTruthAsOftenAsItSays) {
  Rng rng(7);
  int covered = 0;
  constexpr int kTrials = 400;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<std::pair<double, double>> pairs;
    for (int k = 0; k < 60; ++k) {
      const double a = 10.0 * rng.normal();  ///< common to both flights of the pair, so it cancels
      pairs.emplace_back(a, a + 0.3 + rng.normal());
    }
    const PairedDifference d = paired_difference(pairs);
    covered += d.interval.low <= 0.3 && 0.3 <= d.interval.high ? 1 : 0;
    EXPECT_LE(d.interval.low, d.difference);
    EXPECT_GE(d.interval.high, d.difference);
  }
  EXPECT_NEAR(covered / static_cast<double>(kTrials), 0.95, 0.03);
}

TEST(Comparison, PairsBySeedAndCountsWhatOneAloneFlew) {
  Flights b = flights_of(11, 35);
  for (auto& [seed, record] : b.records) record.result.flight_time_s -= 0.5 + 0.01 * static_cast<double>(seed);
  const CampaignComparison c = compare(flights_of(1, 30), b).value();
  EXPECT_EQ(c.pairs, 20);
  EXPECT_EQ(c.only_in_a, 10);
  EXPECT_EQ(c.only_in_b, 5);
  const PairedDifference& time = measure(c, "flight_time_s").difference;
  EXPECT_EQ(time.pairs, 13) << "the flights that both reached: seeds that 3 does not divide";
  EXPECT_NEAR(time.difference, -0.7, 0.02);
  EXPECT_LT(time.interval.high, -0.6);
  EXPECT_EQ(measure(c, "min_clearance_m").difference.pairs, 20);
  EXPECT_EQ(measure(c, "min_clearance_m").difference.different, 0);
}

TEST(Comparison, OfSuccessNamesTheSeedsThatTell) {
  Flights b = flights_of(1, 30);
  for (const std::uint64_t seed : {3U, 6U, 9U, 12U, 15U}) b.records[seed].result.outcome = FlightOutcome::Reached;
  const CampaignComparison c = compare(flights_of(1, 30), b).value();
  EXPECT_EQ(c.successes_a, 20);
  EXPECT_EQ(c.successes_b, 25);
  EXPECT_TRUE(c.a_alone.empty());
  EXPECT_EQ(c.b_alone.size(), 5U);
  EXPECT_NEAR(c.p_value, 2.0 / 32.0, 1e-12);
  EXPECT_THAT(to_text(c, TableForm::Text), HasSubstr("McNemar p = 0.0625"));
}

TEST(Comparison, OfEqualFlightsHasNoIntervals) {
  Flights a = flights_of(1, 5);
  for (auto& [seed, record] : a.records) record.result = a.records[1].result;
  Flights b = a;
  for (auto& [seed, record] : b.records) record.result.flight_time_s += 1.0;
  const CampaignComparison c = compare(a, b).value();
  EXPECT_FALSE(c.may_infer());
  const std::string text = to_text(c, TableForm::Markdown);
  EXPECT_THAT(text, HasSubstr("of 5 flights, 1 of A and 1 of B differ"));
  EXPECT_THAT(text, Not(HasSubstr("McNemar")));
  EXPECT_THAT(text, HasSubstr("| flight_time_s | 5 |"));
  EXPECT_THAT(to_text(compare(a, a).value(), TableForm::Text), HasSubstr("A and B are the same flights"));
}

TEST(Comparison, OfACampaignWithItselfInfersNothing) {
  const CampaignComparison c = compare(flights_of(1, 9), flights_of(1, 9)).value();
  EXPECT_FALSE(c.may_infer());
  EXPECT_THAT(to_text(c, TableForm::Text), HasSubstr("no intervals: A and B are the same flights"));
  EXPECT_THAT(to_text(c, TableForm::Text), Not(HasSubstr("McNemar")));
  Flights other = flights_of(1, 9);
  for (auto& [seed, record] : other.records) record.identity.configuration = "fedcba9876543210";
  EXPECT_TRUE(compare(flights_of(1, 9), other)->may_infer()) << "that nothing changed is a result";
}

TEST(Comparison, OfTwoScenariosIsAnError) {
  Flights other = flights_of(1, 9);
  for (auto& [seed, record] : other.records) record.identity.scenario = "elsewhere";
  const auto c = compare(flights_of(1, 9), other);
  ASSERT_FALSE(c);
  EXPECT_THAT(c.error().message, HasSubstr("\"elsewhere\""));
}

TEST(Comparison, WithoutACommonSeedIsAnError) { EXPECT_FALSE(compare(flights_of(1, 3), flights_of(4, 6))); }

TEST(Comparison, IsATableOfLatex) {
  Flights b = flights_of(1, 9);
  for (auto& [seed, record] : b.records) record.result.flight_time_s += 0.1 * static_cast<double>(seed);
  const std::string text = to_text(compare(flights_of(1, 9), b).value(), TableForm::Latex);
  EXPECT_THAT(text, ::testing::StartsWith("\\begin{tabular}{lrrrrr}"));
  EXPECT_THAT(text, HasSubstr("flight\\_time\\_s & 6 & "));
  EXPECT_THAT(text, HasSubstr("95 \\% interval"));
}

TEST(ColumnNotes, ExplainEveryColumn) {
  const std::vector<ColumnNote> notes = column_notes();
  ASSERT_EQ(notes.size(), flight_columns().size());
  for (std::size_t k = 0; k < notes.size(); ++k) {
    EXPECT_EQ(notes[k].name, flight_columns()[k]);
    EXPECT_FALSE(notes[k].meaning.empty()) << notes[k].name;
  }
}

}  // namespace
}  // namespace tern
