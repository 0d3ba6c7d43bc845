// The paper's 6.1: the search goes to what attracts, away from what repels, and clear of the obstacle in every segment.
#include "campaign/experiments/search_experiment.h"

#include <gtest/gtest.h>

#include <algorithm>

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

TEST(PaperSearch, TheFigureShowsEveryCase) {
  std::vector<SearchOutcome> outcomes;
  for (const SearchCase& c : search_cases()) outcomes.push_back(run_search_case(c));
  const std::string svg = draw_search(outcomes);
  for (const SearchCase& c : search_cases()) EXPECT_NE(svg.find(c.title), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_LT(svg.size(), 200'000U);
}

}  // namespace
}  // namespace tern
