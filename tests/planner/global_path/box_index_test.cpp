#include "planner/global_path/box_index.h"

#include <gtest/gtest.h>

#include "core/base/random.h"

namespace tern {
namespace {

Vec3 random_point(Rng& rng, double size) {
  const double x = rng.uniform(-size, size);
  const double y = rng.uniform(-size, size);
  return {x, y, rng.uniform(-size, size)};
}

std::vector<Box> random_boxes(Rng& rng, int n) {
  std::vector<Box> boxes;
  for (int i = 0; i < n; ++i) {
    const Vec3 c = random_point(rng, 10.0);
    boxes.push_back(box_around(c, (random_point(rng, 1.0)).cwiseAbs()));
  }
  return boxes;
}

/// The distance from the segment to the box by dense sampling: an upper bound, near enough to tell hits from misses.
double sampled_distance(const Vec3& a, const Vec3& b, const Box& box) {
  double least = box.exteriorDistance(a);
  for (int i = 1; i <= 2000; ++i) least = std::min(least, box.exteriorDistance(a + (b - a) * (i / 2000.0)));
  return least;
}

TEST(SegmentMeetsBox, AgreesWithDenseSampling) {
  Rng rng(7);
  int hits = 0;
  for (int i = 0; i < 3000; ++i) {
    const Box box = box_around(random_point(rng, 1.0), random_point(rng, 2.0).cwiseAbs());
    const Vec3 a = random_point(rng, 4.0);
    const Vec3 b = random_point(rng, 4.0);
    const bool hit = segment_meets_box(a, b, box);
    hits += hit ? 1 : 0;
    const double distance = sampled_distance(a, b, box);
    EXPECT_TRUE(hit ? distance < 0.01 : distance > 0.0) << distance;
  }
  EXPECT_GT(hits, 300);
}

TEST(SegmentMeetsBox, HoldsAtTheHardCases) {
  const Box box(Vec3(0, 0, 0), Vec3(1, 1, 1));
  EXPECT_TRUE(segment_meets_box({0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}, box)) << "a point inside";
  EXPECT_TRUE(segment_meets_box({1, 1, 1}, {1, 1, 1}, box)) << "a point on the corner";
  EXPECT_FALSE(segment_meets_box({1.1, 1, 1}, {1.1, 1, 1}, box)) << "a point outside";
  EXPECT_TRUE(segment_meets_box({-1, 1, 0.5}, {2, 1, 0.5}, box)) << "along a face";
  EXPECT_TRUE(segment_meets_box({-1, 1, 1}, {2, 1, 1}, box)) << "along an edge";
  EXPECT_TRUE(segment_meets_box({-1, -1, -1}, {0, 0, 0}, box)) << "ends at a corner";
  EXPECT_FALSE(segment_meets_box({-1, -1, -1}, {-1e-9, -1e-9, -1e-9}, box)) << "ends before a corner";
  EXPECT_FALSE(segment_meets_box({-1, 1.0001, 0.5}, {2, 1.0001, 0.5}, box)) << "passes by";
}

TEST(BoxIndex, FindsWhatALoopFinds) {
  Rng rng(11);
  for (const int n : {0, 1, 4, 5, 37, 400}) {
    const std::vector<Box> boxes = random_boxes(rng, n);
    const BoxIndex index(boxes);
    for (int i = 0; i < 200; ++i) {
      const Box region = box_around(random_point(rng, 10.0), random_point(rng, 3.0).cwiseAbs());
      const Vec3 a = random_point(rng, 10.0);
      const Vec3 b = random_point(rng, 10.0);
      std::vector<std::int32_t> found;
      bool blocked = false;
      for (int k = 0; k < n; ++k) {
        if (boxes[static_cast<std::size_t>(k)].intersects(region)) found.push_back(k);
        blocked |= segment_meets_box(a, b, grown(boxes[static_cast<std::size_t>(k)], Vec3::Constant(kPathClearance)));
      }
      EXPECT_EQ(index.query(region), found);
      EXPECT_EQ(index.blocks(a, b), blocked);
    }
  }
}

TEST(BoxIndex, PassesOverTheBoxesThatHoldTheExemptPoint) {
  const BoxIndex index({Box(Vec3(0, 0, 0), Vec3(1, 1, 1)), Box(Vec3(3, 0, 0), Vec3(4, 1, 1))});
  const Vec3 inside(0.5, 0.5, 0.5);
  EXPECT_TRUE(index.blocks(inside, {2, 0.5, 0.5}));
  EXPECT_FALSE(index.blocks(inside, {2, 0.5, 0.5}, inside));
  EXPECT_TRUE(index.blocks(inside, {5, 0.5, 0.5}, inside));
}

/// A thin wall and a start in the margin by which it was grown: the path leads around it.
TEST(BoxIndex, WhoIsInTheMarginOfABoxLeavesItButDoesNotGoThrough) {
  const BoxIndex index({Box(Vec3(0, 0, 0), Vec3(0.2, 10, 10))});
  const Vec3 start(0.19, 5, 5);
  EXPECT_TRUE(index.blocks(start, {-1, 5, 5}, start)) << "through";
  EXPECT_TRUE(index.blocks(start, {0.15, 5, 5}, start)) << "deeper";
  EXPECT_FALSE(index.blocks(start, {1, 5, 5}, start)) << "out";
  EXPECT_FALSE(index.blocks(start, {0.19, 9, 5}, start)) << "along";
  EXPECT_FALSE(index.blocks(start, start, start));
}

/// Only the part of a box deeper than a point blocks a path from it, never the point itself.
TEST(BoxIndex, TheCoreBeyondAPointIsAllOfTheBoxOrExcludesThePoint) {
  Rng rng(11);
  for (int trial = 0; trial < 20'000; ++trial) {
    const Vec3 half(rng.uniform(0.01, 1.0), rng.uniform(0.01, 1.0), rng.uniform(0.01, 1.0));
    const Box box(-half, half);
    const Vec3 p(rng.uniform(-1.2, 1.2), rng.uniform(-1.2, 1.2), rng.uniform(-1.2, 1.2));
    const Box core = core_beyond(box, p);
    if (!grown(box, Vec3::Constant(kPathClearance)).contains(p)) {
      EXPECT_TRUE(core.isApprox(box));
    } else if (!core.isEmpty()) {
      EXPECT_FALSE(grown(core, Vec3::Constant(kPathClearance)).contains(p));
      EXPECT_TRUE(box.contains(core));
    }
  }
}

TEST(BoxIndex, TakesManyEqualBoxes) {
  const BoxIndex index(std::vector<Box>(1000, Box(Vec3(0, 0, 0), Vec3(1, 1, 1))));
  EXPECT_EQ(index.query(Box(Vec3(1, 1, 1), Vec3(2, 2, 2))).size(), 1000u);
}

}  // namespace
}  // namespace tern
