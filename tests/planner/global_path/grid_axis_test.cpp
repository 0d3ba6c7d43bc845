#include "planner/global_path/grid_axis.h"

#include <gtest/gtest.h>

#include "core/base/random.h"

namespace tern {
namespace {

TEST(GridAxis, HasBothEndsAndPassesThroughTheAnchor) {
  const GridAxis axis(-1.1, 1.3, 0.25, 0.125);
  EXPECT_EQ(axis.low(), -1.1);
  EXPECT_EQ(axis.high(), 1.3);
  EXPECT_TRUE(axis.has_line_between(0.124, 0.126));
  for (int i = 0; i + 1 < axis.size(); ++i) {
    EXPECT_GT(axis[i + 1], axis[i]);
    EXPECT_LE(axis[i + 1] - axis[i], 0.25 * 1.25 + 1e-12);
  }
}

TEST(GridAxis, CellIsTheLastLineAtOrBelow) {
  Rng rng(3);
  for (int trial = 0; trial < 200; ++trial) {
    const double low = rng.uniform(-5, 5);
    GridAxis axis(low, low + rng.uniform(0, 10), 0.25, rng.uniform(-1, 1));
    std::vector<double> more;
    for (int k = 0; k < 5; ++k) more.push_back(rng.uniform(-6, 16));
    axis.add(more);
    for (int k = 0; k < 50; ++k) {
      const double x = rng.uniform(-7, 17);
      int expected = 0;
      while (expected + 2 < axis.size() && axis[expected + 1] <= x) ++expected;
      ASSERT_EQ(axis.cell(x), expected) << x;
    }
  }
}

TEST(GridAxis, MayBeASingleLine) {
  const GridAxis axis(2.0, 2.0, 0.25, 0.0);
  EXPECT_EQ(axis.size(), 1);
  EXPECT_EQ(axis.cell(1.0), 0);
  EXPECT_EQ(axis.cell(3.0), 0);
}

}  // namespace
}  // namespace tern
