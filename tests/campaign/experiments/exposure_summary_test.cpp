#include "campaign/experiments/exposure_summary.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tern {
namespace {

SemanticFlight flight(const std::string& world, const std::string& method, std::uint64_t seed, double inside_m,
                      double length_m, FlightOutcome outcome = FlightOutcome::Reached) {
  SemanticFlight f;
  f.flown = {world, method, method == "off" ? 0.0 : 2.0};
  f.seed = seed;
  f.outcome = outcome;
  f.path_length_m = length_m;
  f.exposure.metres = inside_m;
  return f;
}

TEST(MeanInterval, IsStudentsT) {
  // t_{0.975, 3} = 3.18245; the standard error of 1, 2, 3, 4 is √(5/3)/2.
  const MeanInterval m = mean_interval({1, 2, 3, 4});
  EXPECT_DOUBLE_EQ(m.mean, 2.5);
  EXPECT_NEAR(m.half, 3.18245 * std::sqrt(5.0 / 3.0) / 2.0, 1e-4);
  EXPECT_EQ(mean_interval({7}).half, 0.0);
  EXPECT_EQ(mean_interval({}).n, 0);
}

TEST(ExposureSummary, ComparesFlightsOfOneSeedAndOnlyThoseThatArrived) {
  const auto summaries = summarize_exposure(
      {flight("paper_repel", "off", 1, 15, 75), flight("paper_repel", "off", 2, 13, 76),
       flight("paper_repel", "off", 3, 9, 70, FlightOutcome::Collision),
       flight("paper_repel", "exposure+path", 1, 1, 75.5), flight("paper_repel", "exposure+path", 2, 0, 76.1),
       flight("paper_repel", "exposure+path", 3, 5, 90)});
  ASSERT_EQ(summaries.size(), 2U);
  EXPECT_EQ(summaries[0].reached, 2);
  const ExposureSummary& with = summaries[1];
  EXPECT_EQ(with.inside_m.n, 3);
  EXPECT_EQ(with.gained_m.n, 2) << "seed 3 has nothing to be compared with";
  EXPECT_DOUBLE_EQ(with.gained_m.mean, 13.5) << "metres avoided are gained";
  EXPECT_NEAR(with.longer_m.mean, 0.3, 1e-12);
}

TEST(ExposureSummary, MetresInsideWhatAttractsAreGained) {
  const auto summaries = summarize_exposure(
      {flight("paper_attract", "off", 1, 15, 75), flight("paper_attract", "mean_distance", 1, 30, 76)});
  EXPECT_DOUBLE_EQ(summaries.at(1).gained_m.mean, 15.0);
}

TEST(SemanticFlight, SaysWhatTheCampaignRecordedOfTheWorldsOneRegion) {
  FlightRecord record;
  record.seed = 17;
  record.result.outcome = FlightOutcome::Reached;
  record.result.path_length_m = 76.5;
  record.result.exposure = {{"facade", 5.0, 30.25, 5.5, 32.0}};
  const SemanticFlight f = semantic_flight({"paper_attract", "mean_distance+path", 2.0}, record);
  const std::string csv = to_csv(std::vector{f});
  EXPECT_NE(csv.find("\npaper_attract,mean_distance+path,2,17,reached,0.0000,76.5000,0.0000,30.2500,5.0000,32.0000,"),
            std::string::npos)
      << csv;
  record.result.exposure.clear();
  EXPECT_EQ(semantic_flight(f.flown, record).exposure.metres, 0.0);
}

TEST(SemanticCases, CoverEveryMethodAndLambda) {
  EXPECT_EQ(on_off_cases().size(), 6U);
  EXPECT_EQ(sweep_cases().size(), 2U * (1U + 4U * 5U));
  EXPECT_THROW((void)semantic_method("none"), std::invalid_argument);
}

}  // namespace
}  // namespace tern
