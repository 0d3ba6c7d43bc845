// Coverage of prediction intervals: bounds that hold for any dependence within a group, and counts that can be summed.
#include "campaign/statistics/coverage.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "campaign/statistics/grouped_share.h"
#include "core/base/random.h"

namespace tern {
namespace {

TEST(GroupedShare, WithoutGroupsIsUnknown) {
  EXPECT_EQ(share_interval({}).low, 0.0);
  EXPECT_EQ(share_interval({}).high, 1.0);
}

RC_GTEST_PROP(GroupedShare, LiesWithinItsIntervalAndMirrors, ()) {
  std::vector<GroupShare> groups, rest;
  double all = 0.0, some = 0.0;
  for (int k = *rc::gen::inRange(1, 40); k > 0; --k) {
    const int n = *rc::gen::inRange(1, 200);
    groups.push_back({static_cast<double>(n), static_cast<double>(*rc::gen::inRange(0, n + 1))});
    rest.push_back({groups.back().all, groups.back().all - groups.back().some});
    all += groups.back().all, some += groups.back().some;
  }
  const Interval interval = share_interval(groups), mirrored = share_interval(rest);
  RC_ASSERT(0.0 <= interval.low && interval.low <= some / all && some / all <= interval.high && interval.high <= 1.0);
  RC_ASSERT(std::abs(interval.low + mirrored.high - 1.0) < 1e-6);
  RC_ASSERT(share_lower_bound(groups, 1e-5) <= interval.low);
}

TEST(GroupedShare, OfEqualGroupsIsAlmostAsTightAsTheBinomialInterval) {
  // Clopper and Pearson: 990 of 1000 [0.9817, 0.9952]; 1000 of 1000 from 0.9963.
  std::vector<GroupShare> groups(1000, GroupShare{1.0, 1.0});
  EXPECT_GT(share_interval(groups).low, 0.993);
  for (std::size_t k = 0; k < 10; ++k) groups[k].some = 0.0;
  EXPECT_GT(share_interval(groups).low, 0.97);
  EXPECT_LT(share_interval(groups).high, 0.9975);
}

TEST(GroupedShare, ErrsAsRarelyAsItStatesForAnyDependenceWithinAGroup) {
  // Groups of all sizes, each kept or missed as a whole: the worst dependence there is. The truth is 0.9.
  constexpr int kTrials = 2000;
  int above = 0, below = 0;
  Rng rng(1);
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<GroupShare> groups;
    for (int k = 0; k < 40; ++k) {
      const double all = std::ceil(rng.uniform(0.0, 100.0));
      groups.push_back({all, rng.uniform() < 0.9 ? all : 0.0});
    }
    const Interval interval = share_interval(groups, 0.1);
    above += interval.low > 0.9 ? 1 : 0;
    below += interval.high < 0.9 ? 1 : 0;
  }
  EXPECT_LE(above, 0.05 * kTrials);
  EXPECT_LE(below, 0.05 * kTrials);
}

TEST(GroupedShare, RefutesAShareThatManyGroupsMissALittle) {
  const std::vector<GroupShare> groups(15, GroupShare{100.0, 90.0});
  EXPECT_LT(share_upper_bound(groups, 1e-5), 0.99);
}

Coverage some_flight(Rng& rng) {
  Coverage flight;
  flight.confidence = 0.99;
  for (const PredictionClass kind : {PredictionClass::Declared, PredictionClass::New, PredictionClass::Old}) {
    for (std::size_t h = 0; h < kHorizons; ++h) {
      IntervalCount count{100, {}, std::round(rng.uniform(0.0, 1e4)) * 1e-2};
      for (auto& covered : count.covered) covered = static_cast<std::int64_t>(rng.uniform(0.0, 101.0));
      flight.intervals[{kind, h}] = count;
    }
  }
  flight.claims[3] = {7, 5};
  return flight;
}

TEST(Coverage, ReadsBackWhatItWrote) {
  Rng rng(3);
  const Coverage flight = some_flight(rng);
  const auto back = parse_coverage(to_text(flight));
  ASSERT_TRUE(back);
  EXPECT_EQ(to_text(*back), to_text(flight));
  EXPECT_EQ(back->claims, flight.claims);
  EXPECT_EQ(parse_coverage(""), Coverage{});
  EXPECT_EQ(to_text(Coverage{}), "");
}

TEST(Coverage, RefusesOtherTexts) {
  for (const char* text : {"{}", "[]", "x", R"({"confidence": 0.99, "claims": [], "old": {}})",
                           R"({"confidence":0.99,"claims":[[0,0],[0,0],[0,0],[0,0],[0,0]],"elder":{}})",
                           R"({"confidence":0.99,"claims":[[0,0],[0,0],[0,0],[0,0],[0,0]],"old":{"3":[1,1,1]}})"}) {
    EXPECT_FALSE(parse_coverage(text)) << text;
  }
}

TEST(Coverage, OfAllFlightsIsTheSumAndItsGroupsAreFlights) {
  Rng rng(5);
  const std::vector<Coverage> flights{some_flight(rng), some_flight(rng), some_flight(rng)};
  for (const CoverageShare& share : coverage_shares(flights)) {
    EXPECT_EQ(share.groups, 3);
    EXPECT_EQ(share.made, share.what == kPlans ? 21 : 300);
    EXPECT_EQ(share.confidence == 1.0, share.what == "declared");
  }
}

TEST(Coverage, MarksARefutedShare) {
  Coverage flight;
  flight.confidence = 0.99;
  flight.intervals[{PredictionClass::Old, 0}] = {100, {80, 100, 100, 100, 100}, 10.0};
  const std::string text = to_text(coverage_shares(std::vector<Coverage>(20, flight)));
  EXPECT_NE(text.find("]!"), std::string::npos) << text;
  flight.intervals[{PredictionClass::Old, 0}].covered[0] = 99;
  EXPECT_EQ(to_text(coverage_shares(std::vector<Coverage>(20, flight))).find("]!"), std::string::npos);
}

}  // namespace
}  // namespace tern
