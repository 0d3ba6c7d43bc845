#include "planner/semantics/semantic_fields.h"

#include <gtest/gtest.h>

#include <bitset>
#include <cmath>
#include <utility>
#include <vector>

#include "tests/support/voxel_maps.h"

namespace tern {
namespace {

/// [2, 5] × [1, 3] × [1, 2] attractive; [6, 7] × [0, 4] × [0, 4] repulsive.
VoxelMap two_regions() {
  VoxelMap map = support::free_map({40, 16, 16});
  support::paint(map, {8, 4, 4}, {19, 11, 7}, VoxelLabel::Attractive);
  support::paint(map, {24, 0, 0}, {27, 15, 15}, VoxelLabel::Repulsive);
  return map;
}

double distance_to_voxels(const VoxelMap& map, VoxelLabel label, const Vec3& p) {
  double nearest = INFINITY;
  for (std::size_t i = 0; i < map.labels.size(); ++i) {
    if (map.labels[i] != label) continue;
    nearest = std::min(nearest, map.grid.box(map.grid.cell(static_cast<std::int64_t>(i))).exteriorDistance(p));
  }
  return nearest;
}

TEST(SemanticFields, ExposureRampsFromTheFaceOverTheMargin) {
  const SemanticFields fields(two_regions());
  EXPECT_EQ(fields.exposure_cost(VoxelLabel::Repulsive, Vec3(6.5, 2, 2)), 1.0);
  EXPECT_EQ(fields.exposure_cost(VoxelLabel::Attractive, Vec3(3, 2, 1.5)), 0.0);
  for (const double d : {0.1, 0.25, 0.5, 0.77}) {
    EXPECT_NEAR(fields.exposure_cost(VoxelLabel::Repulsive, Vec3(6 - d, 2, 2)), 1 - d, 1e-6);
    EXPECT_NEAR(fields.exposure_cost(VoxelLabel::Attractive, Vec3(3, 3 + d, 1.5)), d, 1e-6);
  }
  EXPECT_EQ(fields.exposure_cost(VoxelLabel::Repulsive, Vec3(4.9, 2, 2)), 0.0);
  EXPECT_EQ(fields.exposure_cost(VoxelLabel::Attractive, Vec3(3, 4.1, 1.5)), 1.0);
  EXPECT_EQ(fields.exposure_cost(VoxelLabel::Repulsive, Vec3(1000, 2, 2)), 0.0);
  EXPECT_EQ(fields.exposure_cost(VoxelLabel::Attractive, Vec3(1000, 2, 2)), 1.0);
}

TEST(SemanticFields, ExposureIsTheDistanceToTheVoxelsWithinTheStatedError) {
  VoxelMap map = support::free_map({24, 20, 12}, 0.25, Vec3(-1, 2, 0));
  Rng rng(3);
  support::sprinkle(map, rng, 0.01, VoxelLabel::Repulsive);
  support::sprinkle(map, rng, 0.01, VoxelLabel::Attractive);
  const SemanticFields fields(map);
  const double error = DistanceBand::kBandError * map.grid.resolution;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 u(rng.uniform(), rng.uniform(), rng.uniform());
    const Vec3 p =
        map.grid.bounds().min() - Vec3::Ones() + u.cwiseProduct(map.grid.bounds().sizes() + 2 * Vec3::Ones());
    const double repulsive = std::clamp(1.0 - distance_to_voxels(map, VoxelLabel::Repulsive, p), 0.0, 1.0);
    const double attractive = std::clamp(distance_to_voxels(map, VoxelLabel::Attractive, p), 0.0, 1.0);
    EXPECT_NEAR(fields.exposure_cost(VoxelLabel::Repulsive, p), repulsive, error);
    EXPECT_NEAR(fields.exposure_cost(VoxelLabel::Attractive, p), attractive, error);
  }
}

TEST(SemanticFields, LineIntegralsCountMetres) {
  const SemanticFields fields(two_regions());
  // Through the repulsive slab and both of its ramps: 1 m + 2 · ½ m.
  EXPECT_NEAR(fields.exposure_cost(VoxelLabel::Repulsive, Vec3(4, 2, 2), Vec3(9, 2, 2)), 2.0, 0.1);
  // Past the attractive region: the whole line is outside.
  EXPECT_DOUBLE_EQ(fields.exposure_cost(VoxelLabel::Attractive, Vec3(20, 0, 0), Vec3(23, 4, 0)), 5.0);
  // Within it a line of any length costs nothing.
  EXPECT_EQ(fields.exposure_cost(VoxelLabel::Attractive, Vec3(2.5, 2, 1.5), Vec3(4.5, 2, 1.5)), 0.0);
  EXPECT_EQ(fields.exposure_cost(VoxelLabel::Repulsive, Vec3(6.5, 2, 2), Vec3(6.5, 2, 2)), 0.0) << "no metres, no cost";
}

/// The bound of SemanticFields::mean_distance_cost(label) inside the map, from a field per class.
double mean_distance_error(const VoxelMap& map, VoxelLabel label, const std::vector<double>& lambdas) {
  double sum = 0.0;
  const auto all = static_cast<double>(VoxelTree(map, label).voxels());
  for (std::size_t c = 0; c < lambdas.size(); ++c) {
    VoxelTree tree(map, VoxelKind(label, std::bitset<256>().set(c)));
    if (tree.voxels() == 0) continue;
    const double share = static_cast<double>(tree.voxels()) / all;
    sum += lambdas[c] * share * MeanDistanceField(std::move(tree), map.grid.resolution, map.grid.bounds(), {}).error();
  }
  return sum;
}

TEST(SemanticFields, MeanDistanceStaysWithinItsBound) {
  const VoxelMap map = two_regions();
  const SemanticFields fields(map);
  Rng rng(9);
  for (int i = 0; i < 300; ++i) {
    const Vec3 p(rng.uniform(0, 10), rng.uniform(0, 4), rng.uniform(0, 4));
    double sum = 0.0;
    int n = 0;
    for (std::size_t v = 0; v < map.labels.size(); ++v) {
      if (map.labels[v] != VoxelLabel::Repulsive) continue;
      sum += (p - map.grid.centre(map.grid.cell(static_cast<std::int64_t>(v)))).norm();
      ++n;
    }
    EXPECT_NEAR(fields.mean_distance_cost(VoxelLabel::Repulsive, p), sum / n,
                mean_distance_error(map, VoxelLabel::Repulsive, {1.0}));
  }
}

TEST(SemanticFields, AnswersNothingWithoutVoxels) {
  for (const SemanticFields& fields : {SemanticFields(), SemanticFields(support::free_map({4, 4, 4}))}) {
    for (const VoxelLabel label : {VoxelLabel::Attractive, VoxelLabel::Repulsive, VoxelLabel::Occupied}) {
      EXPECT_FALSE(fields.has(label));
      EXPECT_EQ(fields.mean_distance_cost(label, Vec3::Zero()), 0.0);
    }
    EXPECT_EQ(fields.exposure_cost(VoxelLabel::Attractive, Vec3::Zero()), 0.0);
    EXPECT_EQ(fields.exposure_cost(VoxelLabel::Repulsive, Vec3::Zero(), Vec3::Ones()), 0.0);
  }
}

/// As two_regions, but of classes. The attractive voxels below y = 2 are "moss", the rest "mural". The repulsive ones
/// are "water" but for a "fire" in their middle.
VoxelMap four_classes() {
  VoxelMap map = two_regions();
  map.class_names = {"", "mural", "moss", "water", "fire"};
  for (std::size_t i = 0; i < map.labels.size(); ++i) {
    const Vec3 p = map.grid.centre(map.grid.cell(static_cast<std::int64_t>(i)));
    const bool burns = (p - Vec3(6.5, 2, 2)).cwiseAbs().maxCoeff() < 0.5;
    if (map.labels[i] == VoxelLabel::Attractive) map.classes[i] = p.y() < 2.0 ? 2 : 1;
    if (map.labels[i] == VoxelLabel::Repulsive) map.classes[i] = burns ? 4 : 3;
  }
  map.version = map.compute_version();
  return map;
}

TEST(SemanticFields, EveryClassRepelsWithItsOwnLambdaAndTheStrongestCounts) {
  SemanticFieldsOptions options;
  options.lambda_repulsive = 2.0;
  options.class_lambdas = {{"fire", 8.0}, {"lava", 100.0}};
  const SemanticFields fields(four_classes(), options);
  EXPECT_NEAR(fields.exposure_cost(VoxelLabel::Repulsive, Vec3(6.5, 2, 2)), 8.0, 1e-6);
  EXPECT_NEAR(fields.exposure_cost(VoxelLabel::Repulsive, Vec3(6.5, 3.9, 2)), 2.0, 1e-6) << "1.4 m beside the fire";
  EXPECT_NEAR(fields.exposure_cost(VoxelLabel::Repulsive, Vec3(5.75, 2, 2)), 8.0 * 0.75, 1e-5)
      << "a quarter of a metre before both: the fire is what counts";
}

TEST(SemanticFields, WhatIsMissedOfTheStrongestAttractionIsTheCost) {
  SemanticFieldsOptions options;
  options.lambda_attractive = 3.0;
  options.class_lambdas = {{"moss", 1.0}};
  const SemanticFields fields(four_classes(), options);
  EXPECT_NEAR(fields.exposure_cost(VoxelLabel::Attractive, Vec3(3, 2.5, 1.5)), 0.0, 1e-6) << "in the mural";
  EXPECT_NEAR(fields.exposure_cost(VoxelLabel::Attractive, Vec3(3, 1.01, 1.5)), 2.0, 0.05) << "in the moss";
  EXPECT_DOUBLE_EQ(fields.exposure_cost(VoxelLabel::Attractive, Vec3(3, 9, 1.5)), 3.0);
}

TEST(SemanticFields, EqualLambdasAreOneClass) {
  SemanticFieldsOptions same;
  same.class_lambdas = {{"mural", 1.0}, {"moss", 1.0}, {"fire", 1.0}};
  const SemanticFields one(two_regions());
  const SemanticFields classes(four_classes(), same);
  Rng rng(4);
  for (int i = 0; i < 200; ++i) {
    const Vec3 a(rng.uniform(-1, 11), rng.uniform(-1, 5), rng.uniform(-1, 5));
    const Vec3 b(rng.uniform(-1, 11), rng.uniform(-1, 5), rng.uniform(-1, 5));
    EXPECT_DOUBLE_EQ(classes.exposure_cost(a, b), one.exposure_cost(a, b));
    EXPECT_DOUBLE_EQ(classes.mean_distance_cost(a), one.mean_distance_cost(a));
  }
}

TEST(SemanticFields, MeanDistanceWeighsEveryVoxelByItsClass) {
  SemanticFieldsOptions options;
  options.class_lambdas = {{"moss", 0.25}, {"fire", 8.0}};
  const VoxelMap map = four_classes();
  const SemanticFields fields(map, options);
  const std::vector<double> lambdas = {1.0, 1.0, 0.25, 1.0, 8.0};
  Rng rng(5);
  for (int i = 0; i < 50; ++i) {
    const Vec3 p(rng.uniform(0, 10), rng.uniform(0, 4), rng.uniform(0, 4));
    for (const VoxelLabel label : {VoxelLabel::Attractive, VoxelLabel::Repulsive}) {
      double sum = 0.0;
      int n = 0;
      for (std::size_t v = 0; v < map.labels.size(); ++v) {
        if (map.labels[v] != label) continue;
        sum += lambdas[map.classes[v]] * (p - map.grid.centre(map.grid.cell(static_cast<std::int64_t>(v)))).norm();
        ++n;
      }
      EXPECT_NEAR(fields.mean_distance_cost(label, p), sum / n, mean_distance_error(map, label, lambdas));
    }
  }
}

TEST(SemanticFields, AClassOfNoWeightIsNotThere) {
  SemanticFieldsOptions options;
  options.lambda_attractive = 0.0;
  options.lambda_repulsive = 0.0;
  const SemanticFields nothing(two_regions(), options);
  EXPECT_FALSE(nothing.has_weight());
  EXPECT_TRUE(nothing.has(VoxelLabel::Repulsive));
  EXPECT_EQ(nothing.exposure_cost(Vec3(0, 2, 1.5), Vec3(9, 2, 1.5)), 0.0);
  EXPECT_FALSE(nothing.varies_in(Box(Vec3(0, 0, 0), Vec3(10, 4, 4))));
}

TEST(SemanticFields, LongLinesAreWeighedByTheirPartInReachAlone) {
  const SemanticFields fields(two_regions());
  const Vec3 a(-500, 2, 1.5);
  const Vec3 b(500, 2, 1.5);
  // 1000 m: 3 m in the attractive region and two ramps of 1 m beside it; 1 m and two ramps in the repulsive one.
  EXPECT_NEAR(fields.exposure_cost(a, b), 1000 - 3 - 1 + 2, 0.1);
}

TEST(SemanticFields, NameTheirMap) {
  const VoxelMap map = two_regions();
  const SemanticFields fields(map);
  EXPECT_EQ(fields.map_version(), map.version);
  EXPECT_TRUE(fields.has(VoxelLabel::Attractive));
  EXPECT_TRUE(fields.has(VoxelLabel::Repulsive));
  EXPECT_FALSE(fields.has(VoxelLabel::Occupied));
}

}  // namespace
}  // namespace tern
