#include <gtest/gtest.h>

#include <cmath>

#include "planner/semantics/mean_distance_field.h"
#include "planner/semantics/voxel_tree.h"
#include "tests/support/voxel_maps.h"

namespace tern {
namespace {

/// Eq. 3 as it is written.
double eq3(const VoxelMap& map, VoxelLabel label, const Vec3& p) {
  double sum = 0.0;
  std::int64_t n = 0;
  for (std::size_t i = 0; i < map.labels.size(); ++i) {
    if (map.labels[i] != label) continue;
    sum += (p - map.grid.centre(map.grid.cell(static_cast<std::int64_t>(i)))).norm();
    ++n;
  }
  return sum / static_cast<double>(n);
}

/// A few painted blocks and some single voxels.
VoxelMap random_regions(std::uint64_t seed) {
  Rng rng(seed);
  VoxelMap map = support::free_map({60, 30, 16}, 0.25, Vec3(3, -4, 0));
  const auto draw = [&](int n) { return static_cast<int>(rng.uniform(0, n)); };
  for (int block = draw(4); block >= 0; --block) {
    const Eigen::Vector3i low(draw(50), draw(24), draw(12));
    support::paint(map, low, low + Eigen::Vector3i(draw(9), draw(5), draw(3)), VoxelLabel::Attractive);
  }
  if (draw(2) == 0) support::sprinkle(map, rng, 0.001, VoxelLabel::Attractive);
  return map;
}

Vec3 random_point(Rng& rng, const Box& box) {
  const Vec3 u(rng.uniform(), rng.uniform(), rng.uniform());
  return box.min() + u.cwiseProduct(box.sizes());
}

TEST(VoxelTree, MeanDistanceIsEquationThreeWithinItsBound) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const VoxelMap map = random_regions(seed);
    const VoxelTree tree(map, VoxelLabel::Attractive);
    Rng rng(seed);
    for (int i = 0; i < 50; ++i) {
      const Vec3 p = random_point(rng, grown(map.grid.bounds(), Vec3::Constant(i % 2 == 0 ? 0.0 : 30.0)));
      const double truth = eq3(map, VoxelLabel::Attractive, p);
      for (const double error : {0.2, 0.02, 0.002}) {
        ASSERT_NEAR(tree.mean_distance(p, error), truth, error + 1e-9) << "seed " << seed;
      }
    }
  }
}

TEST(VoxelTree, CountsTheVoxelsOfItsLabel) {
  VoxelMap map = support::free_map({10, 10, 10});
  EXPECT_EQ(VoxelTree(map, VoxelLabel::Repulsive).voxels(), 0);
  support::paint(map, {1, 2, 3}, {4, 4, 4}, VoxelLabel::Repulsive);
  EXPECT_EQ(VoxelTree(map, VoxelLabel::Repulsive).voxels(), 4 * 3 * 2);
  EXPECT_EQ(VoxelTree(map, VoxelLabel::Attractive).voxels(), 0);
}

TEST(MeanDistanceField, IsEquationThreeWithinItsBoundAndNearlyNeverBelow) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const VoxelMap map = random_regions(seed);
    const MeanDistanceOptions options;
    const MeanDistanceField field(VoxelTree(map, VoxelLabel::Attractive), 0.25, map.grid.bounds(), options);
    Rng rng(seed);
    for (int i = 0; i < 100; ++i) {
      const Vec3 p = random_point(rng, map.grid.bounds());
      const double truth = eq3(map, VoxelLabel::Attractive, p);
      ASSERT_LE(field(p), truth + field.error()) << "seed " << seed;
      ASSERT_GE(field(p), truth - options.node_error - 1e-4) << "seed " << seed;
      const Vec3 far = random_point(rng, grown(map.grid.bounds(), Vec3::Constant(20.0)));
      ASSERT_NEAR(field(far), eq3(map, VoxelLabel::Attractive, far), field.error() + options.far_error);
    }
  }
}

TEST(MeanDistanceField, StatesFewCentimetresForALargeRegionAndLessThanASpacingForOneVoxel) {
  VoxelMap map = support::free_map({140, 30, 16});
  support::paint(map, {10, 0, 0}, {10, 0, 0}, VoxelLabel::Attractive);
  const MeanDistanceField one(VoxelTree(map, VoxelLabel::Attractive), 0.25, map.grid.bounds(), {});
  EXPECT_LE(one.error(), 0.46);
  support::paint(map, {10, 0, 0}, {129, 15, 15}, VoxelLabel::Attractive);
  const MeanDistanceField large(VoxelTree(map, VoxelLabel::Attractive), 0.25, map.grid.bounds(), {});
  EXPECT_LE(large.error(), 0.08);
}

TEST(MeanDistanceField, SpreadsItsNodesWhereTheDomainIsLarge) {
  VoxelMap map = support::free_map({10, 10, 10});
  support::paint(map, {1, 2, 3}, {4, 4, 4}, VoxelLabel::Attractive);
  MeanDistanceOptions options;
  options.max_nodes = 1000;
  const Box domain(Vec3(-50, -50, 0), Vec3(50, 50, 20));
  const MeanDistanceField field(VoxelTree(map, VoxelLabel::Attractive), 0.25, domain, options);
  EXPECT_GT(field.spacing(), 5.0);
  Rng rng(2);
  for (int i = 0; i < 500; ++i) {
    const Vec3 p = random_point(rng, domain);
    EXPECT_NEAR(field(p), eq3(map, VoxelLabel::Attractive, p), field.error());
  }
}

}  // namespace
}  // namespace tern
