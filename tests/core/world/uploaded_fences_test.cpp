// Fences that are added to a map that is already made.
#include "core/world/uploaded_fences.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/wire/message_limits.h"
#include "core/world/fence_voxels.h"
#include "tests/support/voxel_maps.h"

namespace tern {
namespace {

const Box kFlightBox(Vec3::Zero(), Vec3(10, 10, 3));

Fence circle(double x, double y, double radius, bool is_inclusion) {
  Fence fence;
  fence.is_inclusion = is_inclusion;
  fence.shape = FenceCircle{{x, y}, radius};
  return fence;
}

VoxelMap some_map() {
  VoxelMap map = support::free_map({40, 40, 12});
  Rng rng(3);
  support::sprinkle(map, rng, 0.2, VoxelLabel::Occupied);
  return map;
}

TEST(UploadedFences, AddWhatTheyForbidAndNothingElse) {
  const VoxelMap before = some_map();
  const std::vector<Fence> fences{circle(5, 5, 4, true), circle(6, 5, 1, false)};
  const auto labels = uploaded_fence_labels(fences, before.grid, kFlightBox).value();
  EXPECT_EQ(labels, fence_labels(fences, before.grid));
  VoxelMap map = before;
  EXPECT_FALSE(holds_fences(map, labels));
  add_uploaded_fences(labels, map);
  EXPECT_TRUE(holds_fences(map, labels));
  EXPECT_EQ(map.version, map.compute_version());
  for (std::size_t k = 0; k < labels.size(); ++k) {
    const bool is_added = labels[k] == VoxelLabel::Occupied && before.labels[k] != VoxelLabel::Occupied;
    ASSERT_EQ(map.labels[k], is_added ? VoxelLabel::Occupied : before.labels[k]);
    ASSERT_EQ(map.class_names[map.classes[k]], is_added ? kUploadedFence : "");
  }
  free_uploaded_fences(map);
  EXPECT_EQ(map.labels, before.labels);
}

TEST(UploadedFences, NoFencesChangeNothing) {
  const VoxelMap before = some_map();
  VoxelMap map = before;
  const auto labels = uploaded_fence_labels({}, map.grid, kFlightBox).value();
  add_uploaded_fences(labels, map);
  EXPECT_EQ(map.version, before.version);
  EXPECT_TRUE(holds_fences(map, labels));
}

TEST(UploadedFences, AMapWithoutAFreeClassNameHoldsThemToo) {
  VoxelMap map = some_map();
  while (map.class_names.size() < kMaxMapClasses)
    map.class_names.push_back("c" + std::to_string(map.class_names.size()));
  const auto labels = uploaded_fence_labels({circle(5, 5, 2, false)}, map.grid, kFlightBox).value();
  add_uploaded_fences(labels, map);
  EXPECT_TRUE(holds_fences(map, labels));
  EXPECT_EQ(map.class_names.size(), std::size_t{kMaxMapClasses});
}

TEST(UploadedFences, AreRefusedWhereTheMapEndsWithinThem) {
  const VoxelGrid grid = some_map().grid;
  EXPECT_TRUE(uploaded_fence_labels({circle(9, 9, 5, false)}, grid, kFlightBox)) << "only the flight box counts";
  const Box larger(Vec3::Zero(), Vec3(12, 10, 3));
  const auto refused = uploaded_fence_labels({circle(9, 9, 5, false)}, grid, larger);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, ::testing::HasSubstr("the map ends within the fences"));
  EXPECT_TRUE(uploaded_fence_labels({circle(2, 2, 1, false)}, grid, larger)) << "this one it covers";
  EXPECT_FALSE(uploaded_fence_labels({circle(2, 2, 1, false)}, grid, Box())) << "they have no ceiling, the map has one";
}

TEST(UploadedFences, AreRefusedIfTheyTakeTooLong) {
  VoxelGrid grid = some_map().grid;
  grid.size = {400, 400, 120};
  grid.resolution = 0.025;
  const std::vector<Fence> many(200, circle(5, 5, 1, false));
  const auto refused = uploaded_fence_labels(many, grid, kFlightBox);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, ::testing::HasSubstr("200 fences in a map of 19200000 voxels take too long"));
}

}  // namespace
}  // namespace tern
