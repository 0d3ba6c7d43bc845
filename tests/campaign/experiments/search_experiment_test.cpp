// The paper's 6.1: the search prefers attracting regions, avoids repelling ones, and is clear in every segment.
#include "campaign/experiments/search_experiment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "campaign/experiments/figure_data.h"

namespace tern {
namespace {

TEST(PaperSearch, TheSearchShiftsIntoWhatAttractsAndAwayFromWhatRepels) {
  const auto& cases = search_cases();
  const SearchOutcome none = run_search_case(cases.at(0));
  const SearchOutcome attracted = run_search_case(cases.at(1));
  const SearchOutcome beside = run_search_case(cases.at(2), {"semantics.lambda_repulsive=0"});
  const SearchOutcome repelled = run_search_case(cases.at(2));
  for (const SearchOutcome* o : {&none, &attracted, &beside, &repelled}) {
    ASSERT_TRUE(o->found);
    const Points& q = o->trajectory.control_points;
    EXPECT_LE((q.col(q.cols() - 1) - o->scenario.uav.goal).norm(), 0.05);
    EXPECT_EQ(o->segments.size(), 6U);
  }
  EXPECT_GT(attracted.inside_m, none.inside_m + 1.0);
  EXPECT_LT(repelled.near_m, beside.near_m - 0.5);
}

TEST(PaperSearch, EveryPlaneSeparatesItsHulls) {
  for (const SearchCase& c : search_cases()) {
    for (const SearchSegment& s : run_search_case(c).segments) {
      if (s.gap_m <= 0.0) continue;
      for (const auto& p : s.obstacle_hull.colwise()) EXPECT_GE(s.plane.signed_distance(p), -1e-9) << c.name;
      for (const auto& p : s.curve_hull.colwise()) EXPECT_LE(s.plane.signed_distance(p), -0.1 + 1e-9) << c.name;
    }
  }
}

TEST(PaperSearch, TheFiguresDataHasEveryCaseWithItsSegments) {
  std::vector<SearchOutcome> outcomes;
  for (const SearchCase& c : search_cases()) outcomes.push_back(run_search_case(c));
  const auto data = nlohmann::json::parse(search_data(outcomes));
  ASSERT_EQ(data.size(), search_cases().size());
  for (std::size_t k = 0; k < data.size(); ++k) {
    EXPECT_EQ(data[k]["title"], search_cases()[k].title);
    EXPECT_EQ(data[k]["regions"].size(), search_cases()[k].name == "none" ? 0U : 1U);
    ASSERT_EQ(data[k]["segments"].size(), 6U);
    EXPECT_EQ(data[k]["segments"][0]["curve"][0], data[k]["start"]);
    EXPECT_EQ(data[k]["segments"][5]["curve_hull"].size(), 4U);
  }
}

}  // namespace
}  // namespace tern
