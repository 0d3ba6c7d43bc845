// The golden logs: recorded answers, planned again by this build.
#include <gtest/gtest.h>

#include "planner/planner_build.h"
#include "tests/replay/golden_flights.h"
#include "tools/replay/replay_report.h"

namespace tern::testing {
namespace {

class GoldenLog : public ::testing::TestWithParam<std::string> {};

TEST_P(GoldenLog, ReplaysWithTheSameOutcomesAndPositionsAndBytesWhereTheyArePromised) {
  const auto replay = replay_log(std::string(TERN_GOLDEN_FOLDER "/") + GetParam() + ".lcm", {});
  ASSERT_TRUE(replay) << replay.error().message;
  EXPECT_GE(replay->plans.size(), 30U);
  EXPECT_EQ(replay_exit_code(*replay, false), 0)
      << replay_text(*replay, false)
      << "If the planner was meant to change: launch_scripts/record_golden.sh renews the golden logs.";
}

std::vector<std::string> names() {
  std::vector<std::string> names;
  for (const GoldenFlight& golden : golden_flights()) names.push_back(golden.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Of, GoldenLog, ::testing::ValuesIn(names()), [](const auto& golden) { return golden.param; });

}  // namespace
}  // namespace tern::testing
