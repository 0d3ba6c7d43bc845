#include "campaign/experiments/svg.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tern {
namespace {

TEST(Svg, EscapesWhatXmlReserves) {
  Svg page(10, 10);
  page.text({1, 2}, "a < b & c > d");
  EXPECT_NE(page.finish().find(">a &lt; b &amp; c &gt; d</text>"), std::string::npos);
}

TEST(RoundTicks, AreRoundWithinTheRangeAndNotTooMany) {
  EXPECT_EQ(round_ticks({-0.4, 4.4}, 5), (std::vector<double>{0, 1, 2, 3, 4}));
  EXPECT_EQ(round_ticks({0, 1000}, 4), (std::vector<double>{0, 500, 1000}));
  EXPECT_EQ(round_ticks({75.2, 75.3}, 2).size(), 3U);
  for (const double tick : round_ticks({-1, 1}, 2)) EXPECT_FALSE(std::signbit(tick) && tick == 0.0) << "minus nought";
}

TEST(PlotFrame, MapsItsRangesToItsCorners) {
  PlotFrame frame;
  frame.corner = {10, 20};
  frame.width = 100;
  frame.height = 50;
  frame.x_range = {-1, 1};
  frame.y_range = {0, 5};
  EXPECT_EQ(frame.at(-1, 5), XY(10, 20));
  EXPECT_EQ(frame.at(1, 0), XY(110, 70));
}

TEST(Viridis, EndsWhereItEnds) {
  EXPECT_EQ(viridis(-1), "#440154");
  EXPECT_EQ(viridis(2), "#fde725");
}

}  // namespace
}  // namespace tern
