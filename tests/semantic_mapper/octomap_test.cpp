#include "semantic_mapper/sources/octomap.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "core/base/random.h"
#include "semantic_mapper/voxel_map/map_builder.h"
#include "tests/support/cloud_files.h"

namespace tern {
namespace {

using support::FileBytes;
using testing::HasSubstr;

FileBytes golden(const std::string& name) {
  std::ifstream stream(TERN_MAP_GOLDEN "/" + name, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::string error_of(const FileBytes& bytes) {
  const auto map = parse_octomap(bytes, "lab.bt", {});
  return map ? "" : map.error().message;
}
std::string error_of(const std::string& text) { return error_of(FileBytes(text.begin(), text.end())); }

struct Counts {
  std::int64_t occupied_leaves = 0, free_leaves = 0, occupied_voxels = 0, free_voxels = 0;
  friend bool operator==(const Counts&, const Counts&) = default;
};
Counts count(const OctoMapFile& map) {
  Counts counts;
  for (const OctoLeaf& leaf : map.leaves) {
    const std::int64_t voxels = std::int64_t{leaf.side} * leaf.side * leaf.side;
    (leaf.is_occupied ? counts.occupied_leaves : counts.free_leaves) += 1;
    (leaf.is_occupied ? counts.occupied_voxels : counts.free_voxels) += voxels;
  }
  return counts;
}

VoxelMap map_of(OctoMapFile octomap, const Box& extents, double resolution) {
  MapSources sources;
  sources.octomaps.push_back(std::move(octomap));
  MapBuildOptions options;
  options.extents = extents;
  options.resolution = resolution;
  options.background = VoxelLabel::Unknown;
  return build_map(sources, options)->map;
}

TEST(OctoMap, HasTheLeavesThatOctoMapsOwnLibraryHas) {
  // Printed by golden/make_octomaps.cpp.
  for (const char* name : {"room.ot", "room.bt"}) {
    const auto room = parse_octomap(golden(name), name, {});
    ASSERT_TRUE(room) << room.error().message;
    EXPECT_DOUBLE_EQ(room->resolution, 0.2);
    const Counts counts = count(*room);
    EXPECT_EQ(counts.occupied_voxels, 680);
    EXPECT_EQ(counts.free_voxels, 1922);
    EXPECT_EQ(counts.occupied_leaves, 680);
    EXPECT_EQ(counts.free_leaves, 1054);
    Box bounds;
    for (const OctoLeaf& leaf : room->leaves) bounds.extend(room->box(leaf));
    EXPECT_LT((bounds.min() - Vec3(-2, -1.6, -0.2)).norm(), 1e-9);
    EXPECT_LT((bounds.max() - Vec3(2, 1.6, 2)).norm(), 1e-9);
  }
  const auto colour = parse_octomap(golden("colour.ot"), "colour.ot", {});
  ASSERT_TRUE(colour) << colour.error().message;
  EXPECT_EQ(count(*colour), (Counts{48, 72, 48, 464}));
}

TEST(OctoMap, OccupiedFreeAndUnknownVoxelsAreThoseOfTheFile) {
  constexpr int kSide = 8;
  Rng rng(1);
  for (int n = 0; n < 20; ++n) {
    std::vector<VoxelLabel> labels(kSide * kSide * kSide);
    for (int i = 0; i < std::ssize(labels); ++i) {  // cubes of 2 × 2 × 2, some of them mixed
      const bool is_first = i % kSide % 2 == 0 && i / kSide % 2 == 0 && i / (kSide * kSide) % 2 == 0;
      const std::int64_t first = i / 2 * 2 % kSide + i / kSide % kSide / 2 * 2 * kSide + i / 128 * 128;
      labels[idx(i)] =
          is_first || rng.uniform() < 0.1 ? static_cast<VoxelLabel>(rng.uniform(0, 3)) : labels[idx(first)];
    }
    for (const bool is_binary : {false, true}) {
      const auto octomap = parse_octomap(support::octomap_file(labels, kSide, is_binary), "lab.bt", {});
      ASSERT_TRUE(octomap) << octomap.error().message;
      EXPECT_LT(octomap->leaves.size(), labels.size());
      const VoxelMap map = map_of(*octomap, Box(Vec3::Zero(), Vec3::Constant(0.5 * kSide)), 0.5);
      EXPECT_EQ(map.labels, labels);
    }
  }
}

TEST(OctoMap, AVoxelIsOccupiedIfAPartOfItIsAndFreeIfItsCentreIs) {
  OctoMapFile octomap;
  octomap.resolution = 0.1;
  octomap.leaves = {{{0, 0, 0}, 4, false}, {{8, 0, 0}, 1, true}};
  const VoxelMap map = map_of(octomap, Box(Vec3::Zero(), Vec3(1.0, 0.25, 0.25)), 0.25);
  ASSERT_EQ(map.labels.size(), 4u);
  EXPECT_EQ(map.labels[0], VoxelLabel::Free);
  EXPECT_EQ(map.labels[1], VoxelLabel::Free) << "its centre, 0.375 m, is free";
  EXPECT_EQ(map.labels[2], VoxelLabel::Unknown);
  EXPECT_EQ(map.labels[3], VoxelLabel::Occupied) << "0.8 to 0.9 m are";
  octomap.leaves = {{{0, 0, 0}, 3, false}};
  EXPECT_EQ(map_of(octomap, Box(Vec3::Zero(), Vec3(1.0, 0.25, 0.25)), 0.25).labels[1], VoxelLabel::Unknown);
}

TEST(OctoMap, AppliesOriginAndUnitAndCountsLeavesThatAreTooFar) {
  std::vector<VoxelLabel> labels(8, VoxelLabel::Unknown);
  labels[7] = VoxelLabel::Occupied;  // the cube from (0.5, 0.5, 0.5) to (1, 1, 1)
  const FileBytes bytes = support::octomap_file(labels, 2, true);
  const auto octomap = parse_octomap(bytes, "lab.bt", {Vec3(1, 0, 0), 2.0});
  ASSERT_TRUE(octomap);
  ASSERT_EQ(octomap->leaves.size(), 1u);
  EXPECT_EQ(octomap->box(octomap->leaves[0]).min(), Vec3(-1, 1, 1));
  EXPECT_EQ(octomap->box(octomap->leaves[0]).max(), Vec3(0, 2, 2));
  const auto far = parse_octomap(bytes, "lab.bt", {Vec3(2e6, 0, 0), 1.0});
  ASSERT_TRUE(far);
  EXPECT_TRUE(far->leaves.empty());
  EXPECT_EQ(far->too_far, 1);
}

TEST(OctoMap, NamesFileOffsetValueAndLimitOfWhatItRefuses) {
  const std::string first = "# Octomap OcTree binary file\n";
  EXPECT_THAT(error_of(std::string()), HasSubstr("lab.bt, offset 0: no OctoMap"));
  EXPECT_THAT(error_of("LASF"), HasSubstr("no OctoMap"));
  EXPECT_THAT(error_of(first + "id OcTree\nsize 1\nres 0.1\n"), HasSubstr("no line data within"));
  EXPECT_THAT(error_of(first + "id SemanticOcTree\ndata\n"), HasSubstr("offset 29: a tree of the kind SemanticOcTree"));
  EXPECT_THAT(error_of(first + "id \xff\x01\ndata\n"), HasSubstr("offset 29: a tree of the kind ??: "));
  EXPECT_THAT(error_of(first + "id OcTree\nsize 1\nres -1\ndata\n"), HasSubstr("res -1 is not a positive number"));
  EXPECT_THAT(error_of(first + "id OcTree\nsize 1\ndata\n"), HasSubstr("no line res"));
  const std::string good = first + "id OcTree\nsize 1\nres 0.1\ndata\n";
  EXPECT_EQ(error_of(good + std::string("\x02\x00", 2)), "");
  EXPECT_THAT(error_of(good + "\x03"), HasSubstr("the file ends within the tree"));
  std::string deep = good;
  for (int level = 0; level < 16; ++level) deep += std::string("\x03\x00", 2);
  EXPECT_THAT(error_of(deep + "xx"), HasSubstr("a node below level 16"));
  std::string full = "# Octomap OcTree file\nid OcTree\nsize 1\nres 0.1\ndata\n";
  EXPECT_THAT(error_of(full + std::string("\x00\x00\xc0\x7f\x00", 5)), HasSubstr("log-odds of nan"));
  EXPECT_EQ(error_of(first + "id OcTree\nsize 0\nres 0.1\ndata\n"), "") << "an empty tree";
}

}  // namespace
}  // namespace tern
