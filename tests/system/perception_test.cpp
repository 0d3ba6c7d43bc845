// Whole flights among movers that nobody declares, seen 8 m far, late, with noise and without ids.
#include <gtest/gtest.h>

#include "tests/support/watched_flight.h"

namespace tern::testing {
namespace {

class SandoPerception : public ::testing::TestWithParam<int> {};

TEST_P(SandoPerception, TheForestIsFlownThroughUnharmedByTheDefaults) {
  const VirtualFlight flight = fly_and_expect_all_well("sando_perception", {"seed=" + std::to_string(GetParam())});
  EXPECT_LE(flight.result.stops, 1) << "before anything is known of the movers";
  EXPECT_LT(flight.result.flight_time_s, 27.0);
}

INSTANTIATE_TEST_SUITE_P(Seed, SandoPerception, ::testing::Values(2, 11));

}  // namespace
}  // namespace tern::testing
