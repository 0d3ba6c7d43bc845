#include "core/geometry/swept_boxes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/geometry/box.h"
#include "core/geometry/separation.h"
#include "tests/support/exact_separation.h"
#include "tests/support/point_sets.h"

namespace tern {
namespace {

constexpr std::uint64_t kSeed = 20'261'121;
const Points kNoVertices(3, 0);

Vec3 random_vector(Rng& rng, double size) {
  return {rng.uniform(-size, size), rng.uniform(-size, size), rng.uniform(-size, size)};
}

// Returns boxes whose centres are the points of a pair (also flat, repeated, touching and distant ones). Some boxes
// have no size.
std::vector<CentredBox> boxes_at(const Points& centres, Rng& rng) {
  std::vector<CentredBox> boxes;
  for (Eigen::Index k = 0; k < centres.cols(); ++k) {
    const Vec3 half = rng.uniform() < 0.3 ? Vec3(Vec3::Zero()) : Vec3(random_vector(rng, 0.5).cwiseAbs());
    boxes.push_back({centres.col(k), half});
  }
  return boxes;
}

Points corners_of(const std::vector<CentredBox>& boxes) {
  Points corners(3, 8 * static_cast<Eigen::Index>(boxes.size()));
  for (std::size_t k = 0; k < boxes.size(); ++k) {
    corners.middleCols<8>(8 * static_cast<Eigen::Index>(k)) = box_corners(box_around(boxes[k].centre, boxes[k].half));
  }
  return corners;
}

Points sums(const Points& points, const Points& vertices) {
  if (vertices.cols() == 0) return points;
  Points all(3, points.cols() * vertices.cols());
  for (Eigen::Index v = 0; v < vertices.cols(); ++v) {
    all.middleCols(v * points.cols(), points.cols()) = points.colwise() + vertices.col(v);
  }
  return all;
}

TEST(SweptBoxes, SaysWhatExactArithmeticSaysOfTheCorners) {
  Rng rng(kSeed);
  int yes = 0;
  int no = 0;
  int doubt = 0;
  for (int k = 0; k < 5'000; ++k) {
    const PointSets pair = random_pair(static_cast<PairKind>(k % kPairKinds), rng);
    const std::vector<CentredBox> boxes = boxes_at(pair.a, rng);
    const Points vertices = rng.uniform() < 0.3 ? Points(Points::Random(3, 5) * 0.2) : kNoVertices;
    const double clearance = rng.uniform() < 0.5 ? 0.0 : rng.uniform(0.0, 1.0);
    Vec3 direction = rng.uniform() < 0.5 ? Vec3(random_vector(rng, 2.0)) : Vec3(boxes[0].centre - pair.b.col(0));
    const IsSeparated apart = is_separated(boxes, pair.b, vertices, clearance, direction);
    const ExactSeparation truth = exact_separation(corners_of(boxes), sums(pair.b, vertices));
    const double distance = truth.disjoint ? truth.distance : 0.0;
    // Corners and sums are rounded here, at up to 1e4 m.
    constexpr double kRounding = 1e-11;
    const double beyond = distance - clearance - kTouchingTolerance;
    ASSERT_TRUE(apart != IsSeparated::Yes || beyond > -kRounding) << "pair " << k << ", distance " << distance;
    ASSERT_TRUE(apart != IsSeparated::No || beyond < kRounding) << "pair " << k << ", distance " << distance;
    ++(apart == IsSeparated::Yes ? yes : apart == IsSeparated::No ? no : doubt);
  }
  EXPECT_GT(yes, 500);
  EXPECT_GT(no, 500);
  EXPECT_LT(doubt, 5);
}

TEST(SweptBoxes, TheDirectionThatProvedItProvesItAgainAndOthersChangeNothing) {
  Rng rng(kSeed);
  int proven = 0;
  for (int k = 0; k < 5'000; ++k) {
    const PointSets pair = random_pair(PairKind::Generic, rng);
    const std::vector<CentredBox> boxes = boxes_at(pair.a, rng);
    Vec3 first = random_vector(rng, 1.0);
    Vec3 second = random_vector(rng, 1.0);
    const IsSeparated apart = is_separated(boxes, pair.b, kNoVertices, 0.1, first);
    ASSERT_EQ(is_separated(boxes, pair.b, kNoVertices, 0.1, second), apart);
    if (apart != IsSeparated::Yes) continue;
    ++proven;
    const Vec3 before = first;
    ASSERT_EQ(is_separated(boxes, pair.b, kNoVertices, 0.1, first), IsSeparated::Yes);
    ASSERT_EQ(first, before);
    const double lowest = (first.transpose() * corners_of(boxes)).minCoeff();
    const double highest = (first.transpose() * pair.b).maxCoeff();
    ASSERT_GT(lowest - highest, (0.1 + 0.5 * kTouchingTolerance) * first.norm());
  }
  EXPECT_GT(proven, 1'000);
}

TEST(SweptBoxes, PlanesHoldExactlyAndAreAsWideAsTheDistance) {
  Rng rng(kSeed);
  int planes = 0;
  for (int k = 0; k < 3'000; ++k) {
    const PointSets pair = random_pair(static_cast<PairKind>(k % kPairKinds), rng);
    const std::vector<CentredBox> boxes = boxes_at(pair.a, rng);
    const double clearance = rng.uniform() < 0.5 ? 0.0 : 0.2;
    const Points vertices = rng.uniform() < 0.3 ? Points(Points::Random(3, 5) * 0.2) : kNoVertices;
    const Points hull = sums(corners_of(boxes), -vertices);
    const auto found = separate_sweep(boxes, pair.b, vertices, clearance);
    const auto expected = separate(hull, pair.b, clearance);
    if (!found || !expected) {
      const double distance = exact_separation(hull, pair.b).distance;
      const bool in_doubt = std::abs(distance - clearance - kTouchingTolerance) < 1e-8;
      ASSERT_TRUE(found.has_value() == expected.has_value() || in_doubt) << "pair " << k << ", distance " << distance;
      continue;
    }
    ++planes;
    ASSERT_TRUE(exactly_separates(found->plane, hull, pair.b, std::max(clearance, kPlaneMargin))) << "pair " << k;
    ASSERT_NEAR(found->gap, expected->gap, 1e-9) << "pair " << k;
  }
  EXPECT_GT(planes, 500);
}

}  // namespace
}  // namespace tern
