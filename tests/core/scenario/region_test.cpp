#include "core/scenario/region.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/random.h"

namespace tern {
namespace {

const Region kBox{"box", "water", Box(Vec3(1, 2, 3), Vec3(4, 6, 5))};
const Region kBall{"ball", "water", BallRegion{Vec3(1, 2, 3), 2.0}};
/// A concave prism with the shape of an L.
const Region kPrism{"prism", "water", PrismRegion{{{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 4}, {0, 4}}, 1.0, 2.0}};

TEST(Region, ContainsItsInsideAndFaces) {
  EXPECT_TRUE(kBox.contains(Vec3(2, 3, 4)));
  EXPECT_TRUE(kBox.contains(Vec3(1, 2, 3)));
  EXPECT_FALSE(kBox.contains(Vec3(0.99, 3, 4)));
  EXPECT_TRUE(kBall.contains(Vec3(1, 2, 5)));
  EXPECT_FALSE(kBall.contains(Vec3(2.5, 3.5, 4)));
  EXPECT_TRUE(kPrism.contains(Vec3(0.5, 3.5, 1.5)));
  EXPECT_TRUE(kPrism.contains(Vec3(3.5, 0.5, 2.0)));
  EXPECT_FALSE(kPrism.contains(Vec3(2, 2, 1.5))) << "in the notch of the L";
  EXPECT_FALSE(kPrism.contains(Vec3(0.5, 0.5, 2.01)));
}

TEST(Region, DistanceIsEuclidean) {
  EXPECT_DOUBLE_EQ(kBox.distance(Vec3(0, 1, 3.5)), std::sqrt(2.0));
  EXPECT_EQ(kBox.distance(Vec3(2, 3, 4)), 0.0);
  EXPECT_DOUBLE_EQ(kBall.distance(Vec3(1, 7, 3)), 3.0);
  EXPECT_DOUBLE_EQ(kPrism.distance(Vec3(2, 2, 1.5)), 1.0);
  EXPECT_DOUBLE_EQ(kPrism.distance(Vec3(2, 2, 3)), std::sqrt(2.0)) << "aside and above";
  EXPECT_DOUBLE_EQ(kPrism.distance(Vec3(0.5, 0.5, 5)), 3.0);
}

TEST(Region, BothTurningSensesAreTheSamePrism) {
  auto prism = std::get<PrismRegion>(kPrism.shape);
  std::reverse(prism.corners.begin(), prism.corners.end());
  const Region turned{"turned", "water", prism};
  Rng rng(1);
  for (int i = 0; i < 500; ++i) {
    const double x = rng.uniform(-1, 5);
    const double y = rng.uniform(-1, 5);
    const Vec3 p(x, y, rng.uniform(0, 3));
    EXPECT_DOUBLE_EQ(turned.distance(p), kPrism.distance(p));
  }
}

TEST(Region, BoundsHoldWhatItContainsAndDistanceIsOneLipschitz) {
  Rng rng(2);
  for (const Region* region : {&kBox, &kBall, &kPrism}) {
    for (int i = 0; i < 2000; ++i) {
      const Vec3 p(rng.uniform(-2, 8), rng.uniform(-2, 8), rng.uniform(-1, 7));
      const Vec3 q(rng.uniform(-2, 8), rng.uniform(-2, 8), rng.uniform(-1, 7));
      EXPECT_EQ(region->contains(p), region->distance(p) == 0.0);
      EXPECT_LE(std::abs(region->distance(p) - region->distance(q)), (p - q).norm() + 1e-12);
      EXPECT_GE(region->distance(p) + 1e-12, region->bounds().exteriorDistance(p));
    }
  }
}

}  // namespace
}  // namespace tern
