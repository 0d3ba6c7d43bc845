#include "planner/semantics/distance_transform.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/base/random.h"

namespace tern {
namespace {

using Cell = Eigen::Vector3i;

std::vector<float> brute_force(const std::vector<std::uint8_t>& set, const Cell& size) {
  const auto cell = [&](std::size_t i) {
    const int k = static_cast<int>(i);
    return Cell(k % size.x(), k / size.x() % size.y(), k / size.x() / size.y());
  };
  std::vector<float> d(set.size(), std::numeric_limits<float>::infinity());
  for (std::size_t i = 0; i < set.size(); ++i) {
    for (std::size_t j = 0; j < set.size(); ++j) {
      if (set[j] != 0) d[i] = std::min(d[i], static_cast<float>((cell(i) - cell(j)).squaredNorm()));
    }
  }
  return d;
}

TEST(DistanceTransform, EqualsBruteForce) {
  for (std::uint64_t seed = 1; seed <= 80; ++seed) {
    Rng rng(seed);
    const Cell size(1 + static_cast<int>(rng.uniform(0, 14)), 1 + static_cast<int>(rng.uniform(0, 9)),
                    1 + static_cast<int>(rng.uniform(0, 7)));
    std::vector<std::uint8_t> set(static_cast<std::size_t>(size.prod()));
    const double density = rng.uniform() * rng.uniform();
    for (auto& s : set) s = rng.uniform() < density ? 1 : 0;
    ASSERT_EQ(squared_distance_transform(set, size), brute_force(set, size)) << "seed " << seed;
  }
}

TEST(DistanceTransform, IsInfiniteWithoutAnySetVoxel) {
  for (const float d : squared_distance_transform(std::vector<std::uint8_t>(24, 0), {2, 3, 4})) {
    EXPECT_EQ(d, std::numeric_limits<float>::infinity());
  }
  EXPECT_TRUE(squared_distance_transform({}, {0, 3, 4}).empty());
}

}  // namespace
}  // namespace tern
