#include "core/world/box_cover.h"

#include <gtest/gtest.h>

#include "tests/support/voxel_maps.h"

namespace tern {
namespace {

using support::free_map;
using support::paint;
using support::sprinkle;

/// Returns how many boxes contain each voxel's centre.
std::vector<int> count_covers(const VoxelMap& map, const std::vector<Box>& boxes) {
  std::vector<int> count(map.labels.size(), 0);
  for (std::size_t i = 0; i < count.size(); ++i) {
    const Vec3 centre = map.grid.centre(map.grid.cell(static_cast<std::int64_t>(i)));
    for (const Box& box : boxes) count[i] += box.contains(centre) ? 1 : 0;
  }
  return count;
}

void expect_exact_cover(const VoxelMap& map, bool unknown_is_obstacle) {
  const std::vector<Box> boxes = cover_with_boxes(map, unknown_is_obstacle);
  const std::vector<int> count = count_covers(map, boxes);
  for (std::size_t i = 0; i < count.size(); ++i) {
    const bool obstacle =
        map.labels[i] == VoxelLabel::Occupied || (unknown_is_obstacle && map.labels[i] == VoxelLabel::Unknown);
    ASSERT_EQ(count[i], obstacle ? 1 : 0) << "voxel " << i;
  }
}

TEST(BoxCover, CoversExactlyTheObstacleVoxelsOnce) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Rng rng(seed);
    VoxelMap map = free_map({1 + static_cast<int>(rng.uniform(0, 9)), 1 + static_cast<int>(rng.uniform(0, 9)),
                             1 + static_cast<int>(rng.uniform(0, 9))},
                            0.25, Vec3(-1.0, 2.0, 0.5));
    sprinkle(map, rng, rng.uniform(), VoxelLabel::Occupied);
    sprinkle(map, rng, 0.2, VoxelLabel::Unknown);
    sprinkle(map, rng, 0.1, VoxelLabel::Attractive);
    SCOPED_TRACE(seed);
    expect_exact_cover(map, false);
    expect_exact_cover(map, true);
  }
}

TEST(BoxCover, OneBoxForABox) {
  VoxelMap map = free_map({40, 30, 20});
  paint(map, {3, 4, 5}, {33, 14, 9}, VoxelLabel::Occupied);
  const std::vector<Box> boxes = cover_with_boxes(map, false);
  ASSERT_EQ(boxes.size(), 1u);
  EXPECT_EQ(boxes[0].min(), Vec3(0.75, 1.0, 1.25));
  EXPECT_EQ(boxes[0].max(), Vec3(8.5, 3.75, 2.5));
}

TEST(BoxCover, FewBoxesForAWallWithAWindow) {
  VoxelMap map = free_map({20, 40, 20});
  paint(map, {10, 0, 0}, {10, 39, 19}, VoxelLabel::Occupied);
  paint(map, {10, 15, 8}, {10, 18, 11}, VoxelLabel::Free);
  EXPECT_LE(cover_with_boxes(map, false).size(), 5u);
}

TEST(BoxCover, NothingForAnEmptyMap) {
  EXPECT_TRUE(cover_with_boxes(VoxelMap{}, true).empty());
  EXPECT_TRUE(cover_with_boxes(free_map({4, 4, 4}), true).empty());
}

}  // namespace
}  // namespace tern
