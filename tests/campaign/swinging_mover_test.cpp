// A narrow gap that a mover swings across, seen by a noisy sensor: the vehicle must not hover before it.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "campaign/recorded_flight.h"
#include "tests/support/effort.h"
#include "tests/support/temp_folder.h"

namespace tern {
namespace {

/// Returns the scenario with another slowness of the mover.
std::string with_slowness(const std::string& slowness, const TempFolder& folder) {
  std::ifstream in(TERN_SWINGING);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  const std::string key = "slowness: ";
  const std::size_t at = text.find(key) + key.size();
  text.replace(at, text.find(',', at) - at, slowness);
  const std::string file = folder.file("swinging.yaml");
  std::ofstream(file) << text;
  return file;
}

FlightResult fly(const std::string& file, std::uint64_t seed, std::vector<std::string> overrides) {
  const TempFolder folder;
  const FlightInputs inputs{file, std::move(overrides), Charge::Counts};
  return fly_recorded(inputs, seed, check_inputs(inputs, seed), folder.file(""), {}).record.result;
}

class SwingingMover : public ::testing::TestWithParam<std::string> {};

TEST_P(SwingingMover, IsPassedWithoutContactAndMostlyWithinTwiceTheTimeOfKnownMotion) {
  const TempFolder folder;
  const std::string file = with_slowness(GetParam(), folder);
  const FlightResult known = fly(file, 1, {"simulator.declare=true"});
  ASSERT_EQ(known.outcome, FlightOutcome::Reached) << known.detail;
  std::vector<double> times_s;
  for (int seed = 1; seed <= 3 * support::effort(); ++seed) {
    const FlightResult flown = fly(file, static_cast<std::uint64_t>(seed), {});
    EXPECT_EQ(flown.outcome, FlightOutcome::Reached) << "seed " << seed << ": " << flown.detail;
    EXPECT_GT(flown.min_clearance_m, 0.0) << "seed " << seed;
    times_s.push_back(flown.flight_time_s);
  }
  std::ranges::nth_element(times_s, times_s.begin() + static_cast<std::ptrdiff_t>(times_s.size() / 2));
  EXPECT_LE(times_s[times_s.size() / 2], 2.0 * known.flight_time_s);
}

INSTANTIATE_TEST_SUITE_P(OfSlowness, SwingingMover,
                         ::testing::ValuesIn(support::first_at_effort<std::string>(2, {"1.5", "0.5", "1", "2.5"})),
                         [](const auto& slowness) { return "No" + std::to_string(slowness.index); });

}  // namespace
}  // namespace tern
