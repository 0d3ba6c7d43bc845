// Which outlines a prism region may have.
#include "runtime/polygon.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace tern {
namespace {

using Corners = std::vector<Eigen::Vector2d>;

TEST(SimplePolygon, TakesATriangleASquareAndAnLInBothSenses) {
  for (Corners corners : {Corners{{0, 0}, {1, 0}, {0, 1}}, Corners{{0, 0}, {1, 0}, {1, 1}, {0, 1}},
                          Corners{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}}) {
    EXPECT_TRUE(is_simple_polygon(corners));
    std::reverse(corners.begin(), corners.end());
    EXPECT_TRUE(is_simple_polygon(corners));
  }
}

TEST(SimplePolygon, TakesACornerInTheMiddleOfAStraightSide) {
  EXPECT_TRUE(is_simple_polygon({{0, 0}, {1, 0}, {2, 0}, {2, 2}, {0, 2}}));
}

TEST(SimplePolygon, RefusesTooFewCorners) {
  EXPECT_FALSE(is_simple_polygon({}));
  EXPECT_FALSE(is_simple_polygon({{0, 0}, {1, 0}}));
}

TEST(SimplePolygon, RefusesABowTie) { EXPECT_FALSE(is_simple_polygon({{0, 0}, {1, 1}, {1, 0}, {0, 1}})); }

TEST(SimplePolygon, RefusesACornerGivenTwice) {
  EXPECT_FALSE(is_simple_polygon({{0, 0}, {1, 0}, {1, 0}, {0, 1}}));
  EXPECT_FALSE(is_simple_polygon({{0, 0}, {1, 0}, {1, 1}, {0, 0}}));
}

TEST(SimplePolygon, RefusesASpikeAndAFlatTriangle) {
  EXPECT_FALSE(is_simple_polygon({{0, 0}, {2, 0}, {1, 0}, {1, 1}}));
  EXPECT_FALSE(is_simple_polygon({{0, 0}, {1, 0}, {2, 0}}));
}

TEST(SimplePolygon, RefusesACornerThatTouchesAnotherSide) {
  EXPECT_FALSE(is_simple_polygon({{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}}));
}

/// Corners on a circle in the order of their angle are convex; exchanging two neighbours of five or more makes sides
/// cross.
RC_GTEST_PROP(SimplePolygon, TakesCircleOrderAndRefusesItWithTwoCornersExchanged, ()) {
  const int n = *rc::gen::inRange(4, 20);
  const double radius = *rc::gen::inRange(1, 1'000);
  Corners corners;
  for (int i = 0; i < n; ++i) {
    const double angle = 2.0 * M_PI * i / n;
    corners.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  RC_ASSERT(is_simple_polygon(corners));
  const int i = *rc::gen::inRange(0, n);
  std::swap(corners[static_cast<std::size_t>(i)], corners[static_cast<std::size_t>((i + 1) % n)]);
  RC_ASSERT(!is_simple_polygon(corners));
}

}  // namespace
}  // namespace tern
