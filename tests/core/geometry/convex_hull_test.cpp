#include "core/geometry/convex_hull.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "core/geometry/box.h"
#include "tests/support/exact_separation.h"
#include "tests/support/point_sets.h"

namespace tern {
namespace {

bool is_column_of(const Vec3& p, const Points& points) {
  for (const auto& column : points.colwise()) {
    if (column == p) return true;
  }
  return false;
}

Points without_column(const Points& points, Eigen::Index k) {
  Points rest(3, points.cols() - 1);
  rest.leftCols(k) = points.leftCols(k);
  rest.rightCols(rest.cols() - k) = points.rightCols(rest.cols() - k);
  return rest;
}

// Expects that conv(hull) contains every input, and that each vertex is an input outside the hull of the others.
// Exact.
void expect_is_hull(const Points& hull, const Points& points) {
  for (const auto& p : points.colwise()) ASSERT_FALSE(exact_separation(hull, p).disjoint);
  for (Eigen::Index k = 0; k < hull.cols(); ++k) {
    ASSERT_TRUE(is_column_of(hull.col(k), points));
    if (hull.cols() > 1) {
      ASSERT_TRUE(exact_separation(without_column(hull, k), hull.col(k)).disjoint);
    }
  }
}

Points shuffled(const Points& points, Rng& rng) {
  Points result = points;
  for (Eigen::Index k = points.cols() - 1; k > 0; --k) {
    result.col(k).swap(result.col(static_cast<Eigen::Index>(rng.uniform() * static_cast<double>(k + 1))));
  }
  return result;
}

// Returns the corners of a box that moves on a parabola, like those of a sweep.
Points swept_box(Rng& rng, int samples, double away, bool turning) {
  const auto random_vector = [&rng](double size) {
    return Vec3(rng.uniform(-size, size), rng.uniform(-size, size), rng.uniform(-size, size));
  };
  const Vec3 start = random_vector(away), velocity = random_vector(3.0), acceleration = random_vector(4.0);
  const Eigen::AngleAxisd turn(turning ? 0.7 : 0.0, Vec3(1.0, 2.0, 3.0).normalized());
  Points points(3, 8 * samples);
  for (int k = 0; k < samples; ++k) {
    const double t = 0.1 * k;
    const Vec3 centre = start + velocity * t + 0.5 * acceleration * t * t;
    points.middleCols<8>(8 * k) =
        (turn.toRotationMatrix() * box_corners(box_around(Vec3::Zero(), Vec3(0.4, 0.3, 0.2)))).colwise() + centre;
  }
  return points;
}

TEST(ConvexHull, HoldsAllPointsAndNothingSuperfluous) {
  Rng rng(3);
  for (int k = 0; k < 9000; ++k) {
    const PointSets pair = random_pair(static_cast<PairKind>(k % kPairKinds), rng);
    expect_is_hull(hull_vertices(pair.a), pair.a);
    if (HasFatalFailure()) FAIL() << "case " << k << "\n" << pair.a;
  }
}

TEST(ConvexHull, OfASweptBoxIsExactInSpiteOfRounding) {
  Rng rng(4);
  for (int k = 0; k < 120; ++k) {
    const Points points = swept_box(rng, 2 + k % 5, k % 3 == 0 ? 0.01 : 20.0, k % 2 == 1);
    expect_is_hull(hull_vertices(points), points);
    if (HasFatalFailure()) FAIL() << "case " << k << "\n" << points;
  }
}

TEST(ConvexHull, DoesNotDependOnTheOrderOfItsInput) {
  Rng rng(5);
  for (int k = 0; k < 300; ++k) {
    const Points points = k % 2 == 0 ? swept_box(rng, 5, 20.0, false) : random_pair(PairKind::Lattice, rng).a;
    const Points hull = hull_vertices(points);
    ASSERT_EQ(hull, hull_vertices(shuffled(points, rng)));
    ASSERT_EQ(hull, hull_vertices(hull));
  }
}

TEST(ConvexHull, LeavesOutPointsInsideFacesAndEdges) {
  Points points(3, 27);
  for (int k = 0; k < 27; ++k) points.col(k) << k % 3, (k / 3) % 3, k / 9;
  EXPECT_EQ(hull_vertices(points).cols(), 8);
}

TEST(ConvexHull, OfAFlatSetIsItsOutline) {
  for (int axis = 0; axis < 3; ++axis) {
    Points points(3, 9);
    for (int k = 0; k < 9; ++k) points.col(k) << k % 3, k / 3, k % 3 + k / 3;
    points.row(axis).setConstant(0.7);
    EXPECT_EQ(hull_vertices(points).cols(), 4) << "axis " << axis;
    expect_is_hull(hull_vertices(points), points);
  }
}

TEST(ConvexHull, OfALineIsItsEnds) {
  Points points(3, 5);
  points << 0.0, -1.0, 2.0, 1.0, 2.0,  //
      0.0, -2.0, 4.0, 2.0, 4.0,        //
      0.5, 0.5, 0.5, 0.5, 0.5;
  Points ends(3, 2);
  ends << -1.0, 2.0, -2.0, 4.0, 0.5, 0.5;
  EXPECT_EQ(hull_vertices(points), ends);
}

TEST(ConvexHull, OfOnePointRepeatedIsThatPoint) {
  const Points point = Vec3(0.1, -0.2, 0.3);
  EXPECT_EQ(hull_vertices(point), point);
  EXPECT_EQ(hull_vertices(point.replicate(1, 7)), point);
}

TEST(ConvexHull, RefusesNothingAndTheNotFinite) {
  EXPECT_THROW(hull_vertices(Points(3, 0)), std::invalid_argument);
  Points points = Points::Ones(3, 4);
  points(2, 3) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(hull_vertices(points), std::invalid_argument);
  points(2, 3) = std::numeric_limits<double>::infinity();
  EXPECT_THROW(hull_vertices(points), std::invalid_argument);
}

}  // namespace
}  // namespace tern
