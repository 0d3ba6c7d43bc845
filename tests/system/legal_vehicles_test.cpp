// Every legal scenario ends with the goal reached, or with a reason that is true.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "tests/support/effort.h"
#include "tests/support/legal_scenario.h"
#include "tests/support/watched_flight.h"

namespace tern::testing {
namespace {

std::int64_t setting(const char* name, std::int64_t fallback) {
  const char* text = std::getenv(name);
  return text == nullptr ? fallback : std::atoll(text);
}

/// Flies the scenario of this seed and expects no fault. @return how it ended
FlightReason expect_true_end(std::int64_t seed) {
  const std::filesystem::path file =
      std::filesystem::path(::testing::TempDir()) / fmt::format("legal_{}.yaml", ::getpid());
  const LegalScenario legal = legal_scenario(static_cast<std::uint64_t>(seed));
  std::ofstream(file) << legal.yaml;
  PromiseWatch watch;
  const VirtualFlight flight = fly_virtually(file.string(), {}, &watch);
  std::filesystem::remove(file);
  const FlightJudgement judgement = judge(legal, flight, watch);
  EXPECT_EQ(judgement.fault, "") << "seed " << seed << "\n" << legal.yaml;
  return judgement.reason;
}

/// For more seeds, set TERN_LEGAL_SCENARIOS=10000 and TERN_LEGAL_FIRST=1 for this executable.
TEST(LegalScenario, EndsAtItsGoalOrWithAReasonThatIsTrue) {
  const std::int64_t count = setting("TERN_LEGAL_SCENARIOS", support::listed_at_effort(12, 60));
  const std::int64_t first = setting("TERN_LEGAL_FIRST", 1);
  std::array<int, kFlightReasons> reasons{};
  for (std::int64_t seed = first; seed < first + count; ++seed) {
    ++reasons[static_cast<std::size_t>(expect_true_end(seed))];
  }
  for (int k = 0; k < kFlightReasons; ++k) {
    fmt::print("{}: {}\n", to_string(static_cast<FlightReason>(k)), reasons[static_cast<std::size_t>(k)]);
  }
  EXPECT_GE(reasons[static_cast<std::size_t>(FlightReason::Reached)] * 10, count * 8);
}

/// Hard cases:
/// - lopsided bodies at the edge of flight boxes that were widened for them
/// - limits that cross the sphere in one interval, or differ between axes by hundreds
/// - a departure that is postponed at every request
/// - a wall beside the vehicle
/// - staying that is estimated to arrive earlier than any path
/// - an obstacle that appears within the vehicle's reach
TEST(OnceWrongScenario, EndsAtItsGoalOrWithAReasonThatIsTrue) {
  for (const std::int64_t seed : {301, 378, 706, 763, 857, 886, 2828, 3173, 3569, 4932, 6178, 7046, 7158, 7479, 8329}) {
    EXPECT_EQ(expect_true_end(seed), FlightReason::Reached) << seed;
  }
  EXPECT_EQ(expect_true_end(1040), FlightReason::WayBlocked);
  EXPECT_EQ(expect_true_end(4596), FlightReason::WayBlocked) << "its goal lies in an obstacle, half a millimetre deep";
  EXPECT_EQ(expect_true_end(822), FlightReason::HitByNewcomer);
}

}  // namespace
}  // namespace tern::testing
