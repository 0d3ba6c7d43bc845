#include "campaign/experiments/comparison_figure.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/campaign/some_flights.h"

namespace tern {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

Flights nine_flights(double later_s) {
  Flights flights;
  for (std::uint64_t seed = 1; seed <= 9; ++seed) {
    flights.records[seed] = some_flight(seed);
    flights.records[seed].result.flight_time_s += later_s * static_cast<double>(seed);
  }
  return flights;
}

TEST(ComparisonFigure, DrawsEveryMeasureThatDiffersWithItsInterval) {
  const std::string svg = draw_comparison(compare(nine_flights(0.0), nine_flights(0.1)).value());
  EXPECT_THAT(svg, ::testing::StartsWith("<svg"));
  EXPECT_THAT(svg, HasSubstr(">flight_time_s</text>"));
  EXPECT_THAT(svg, HasSubstr("stroke-width=\"3\""));
  EXPECT_THAT(svg, Not(HasSubstr("min_clearance_m"))) << "equal in all pairs";
}

TEST(ComparisonFigure, MarksTheSideOfAMeasureOfWhichAHasNone) {
  Flights a = nine_flights(0.0), b = nine_flights(0.1);
  for (auto& [seed, record] : a.records) record.result.stops = 0;
  const auto hollow = HasSubstr("fill=\"white\" stroke=\"#1357a6\"");
  const std::string svg = draw_comparison(compare(a, b).value());
  EXPECT_THAT(svg, HasSubstr(">stops</text>"));
  EXPECT_THAT(svg, hollow);
  EXPECT_THAT(svg, HasSubstr("hollow: A's mean is 0"));
  EXPECT_THAT(draw_comparison(compare(nine_flights(0.0), b).value()), Not(hollow));
}

TEST(ComparisonFigure, OfEqualFlightsHasNoIntervals) {
  const std::string svg = draw_comparison(compare(nine_flights(0.0), nine_flights(0.0)).value());
  EXPECT_THAT(svg, HasSubstr("no intervals"));
  EXPECT_THAT(svg, Not(HasSubstr("stroke-width=\"3\"")));
}

}  // namespace
}  // namespace tern
