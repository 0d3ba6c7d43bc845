// Whole flights through generated worlds.
#include <gtest/gtest.h>

#include "tests/support/effort.h"
#include "tests/support/watched_flight.h"

namespace tern::testing {
namespace {

class PaperCorridor : public ::testing::TestWithParam<int> {};

TEST_P(PaperCorridor, IsFlownThroughUnharmedAndEveryRequestIsAnsweredOnceAndInTime) {
  fly_and_expect_all_well("paper_corridor", {"world.count=100", "seed=" + std::to_string(GetParam())});
}

INSTANTIATE_TEST_SUITE_P(Seed, PaperCorridor, ::testing::Range(1, 1 + support::listed_at_effort(3, 10)));

class OtherWorlds : public ::testing::TestWithParam<const char*> {};

TEST_P(OtherWorlds, AreFlownThroughUnharmed) { fly_and_expect_all_well(GetParam(), {"seed=1", "executor.rate_hz=10"}); }

INSTANTIATE_TEST_SUITE_P(Scenario, OtherWorlds,
                         ::testing::Values("corridor_demo", "mader_corridor", "sando_forest", "paper_search",
                                           "paper_search_repel"),
                         [](const auto& flight) { return std::string(flight.param); });

}  // namespace
}  // namespace tern::testing
