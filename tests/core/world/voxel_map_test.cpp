#include "core/world/voxel_map.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/voxel_maps.h"

namespace tern {
namespace {

using support::free_map;

VoxelMap random_map(std::uint64_t seed, const Eigen::Vector3i& size, double density) {
  Rng rng(seed);
  VoxelMap map = free_map(size, 0.25, Vec3(-3.5, 2.25, 0.0));
  map.class_names = {"", "water", "wall"};
  for (std::size_t i = 0; i < map.labels.size(); ++i) {
    if (rng.uniform() < density)
      map.labels[i] = static_cast<VoxelLabel>(static_cast<int>(rng.uniform(0, kVoxelLabels)));
    if (rng.uniform() < density) map.classes[i] = static_cast<std::uint8_t>(rng.uniform(0, 3));
  }
  map.version = map.compute_version();
  return map;
}

void expect_same(const VoxelMap& a, const VoxelMap& b) {
  EXPECT_EQ(a.grid.origin, b.grid.origin);
  EXPECT_EQ(a.grid.resolution, b.grid.resolution);
  EXPECT_EQ(a.grid.size, b.grid.size);
  EXPECT_EQ(a.labels, b.labels);
  EXPECT_EQ(a.classes, b.classes);
  EXPECT_EQ(a.class_names, b.class_names);
  EXPECT_EQ(a.version, b.version);
}

TEST(VoxelGrid, CellIndexAndCentreAgree) {
  const VoxelGrid grid{Vec3(-1, 2, 3), 0.5, {3, 4, 5}};
  EXPECT_EQ(grid.voxels(), 60);
  for (std::int64_t i = 0; i < grid.voxels(); ++i) {
    EXPECT_EQ(grid.index(grid.cell(i)), i);
    EXPECT_EQ(grid.cell_of(grid.centre(grid.cell(i))), grid.cell(i));
    EXPECT_TRUE(grid.contains(grid.cell(i)));
    EXPECT_TRUE(grid.bounds().contains(grid.box(grid.cell(i))));
  }
  EXPECT_EQ(grid.cell(1), Eigen::Vector3i(1, 0, 0)) << "x runs fastest";
  EXPECT_FALSE(grid.contains(grid.cell_of(Vec3(-1.01, 2.1, 3.1))));
}

TEST(MapChunks, JoinToTheMapThatWasCutInAnyOrder) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const VoxelMap map = random_map(seed, {40, 30, 20}, 0.9);
    std::vector<MapChunk> chunks = to_chunks(map);
    ASSERT_GT(chunks.size(), 1u);
    Rng rng(seed);
    for (std::size_t i = chunks.size(); i > 1; --i)
      std::swap(chunks[i - 1], chunks[static_cast<std::size_t>(rng.uniform(0, static_cast<double>(i)))]);
    chunks.insert(chunks.begin() + 1, chunks.front());  // one comes twice
    MapAssembler assembler;
    for (std::size_t i = 0; i < chunks.size(); ++i) {
      const auto done = assembler.add(chunks[i]);
      ASSERT_TRUE(done);
      EXPECT_EQ(*done, i + 1 == chunks.size());
    }
    expect_same(assembler.take(), map);
  }
}

TEST(MapChunks, StayWithinTheirLimits) {
  const VoxelMap map = random_map(3, {60, 60, 20}, 1.0);
  const std::vector<MapChunk> chunks = to_chunks(map);
  for (std::size_t k = 0; k < chunks.size(); ++k) {
    EXPECT_LE(chunks[k].runs.size(), static_cast<std::size_t>(kMaxRunsPerChunk));
    EXPECT_EQ(chunks[k].index, static_cast<int>(k));
    EXPECT_EQ(chunks[k].count, static_cast<int>(chunks.size()));
    EXPECT_EQ(chunks[k].version, map.version);
  }
}

TEST(MapChunks, ThereIsOneEvenForAnEmptyGrid) {
  const VoxelMap map = free_map({0, 0, 0});
  const std::vector<MapChunk> chunks = to_chunks(map);
  ASSERT_EQ(chunks.size(), 1u);
  MapAssembler assembler;
  EXPECT_TRUE(assembler.add(chunks[0]).value());
  expect_same(assembler.take(), map);
}

TEST(MapAssembler, GivesAFinishedVersionOnce) {
  const VoxelMap map = random_map(1, {5, 5, 5}, 0.5);
  MapAssembler assembler;
  EXPECT_TRUE(assembler.add(to_chunks(map)[0]).value());
  EXPECT_FALSE(assembler.add(to_chunks(map)[0]).value());
}

TEST(MapAssembler, ANewerVersionReplacesAnUnfinishedOne) {
  const VoxelMap first = random_map(1, {40, 30, 20}, 0.9);
  const VoxelMap second = random_map(2, {40, 30, 20}, 0.9);
  MapAssembler assembler;
  EXPECT_FALSE(assembler.add(to_chunks(first)[0]).value());
  const std::vector<MapChunk> chunks = to_chunks(second);
  for (const MapChunk& chunk : chunks) EXPECT_EQ(assembler.add(chunk).value(), &chunk == &chunks.back());
  expect_same(assembler.take(), second);
}

TEST(MapAssembler, OfTwoSendersListensToTheFirstUntilThatIsSilent) {
  const auto chunks_of = [](std::uint64_t seed, std::int64_t epoch_us) {
    std::vector<MapChunk> chunks = to_chunks(random_map(seed, {40, 30, 20}, 0.9));
    for (MapChunk& chunk : chunks) chunk.header.name.sender_epoch_us = epoch_us;
    return chunks;
  };
  const std::vector<MapChunk> first = chunks_of(1, 100), second = chunks_of(2, 200);
  MapAssembler assembler;
  UTime now{1'000'000};
  const auto send = [&](MapChunk chunk) {
    chunk.header.utime = now;
    return assembler.add(chunk).value();
  };
  std::vector<std::uint64_t> complete;
  for (int round = 0; round < 3; ++round) {
    for (std::size_t k = 0; k < std::max(first.size(), second.size()); ++k) {
      if (send(second[k % second.size()])) complete.push_back(assembler.take().version);
      if (send(first[k % first.size()])) complete.push_back(assembler.take().version);
    }
  }
  EXPECT_EQ(complete, std::vector{second[0].version});
  now = now + kMapSilence + Duration{1};
  for (const MapChunk& chunk : first) {
    if (send(chunk)) complete.push_back(assembler.take().version);
  }
  EXPECT_EQ(complete, (std::vector{second[0].version, first[0].version})) << "though it started earlier";
}

TEST(MapAssembler, RefusesWhatContradictsItself) {
  const VoxelMap map = random_map(1, {40, 30, 20}, 0.9);
  const std::vector<MapChunk> chunks = to_chunks(map);
  const auto refuses = [&](auto change) {
    MapAssembler assembler;
    EXPECT_FALSE(assembler.add(chunks[0]).value());
    MapChunk changed = chunks[1];
    change(changed);
    Result<bool> result = assembler.add(changed);
    for (std::size_t k = 2; result && k < chunks.size(); ++k) result = assembler.add(chunks[k]);
    return !result.has_value();
  };
  EXPECT_FALSE(refuses([](MapChunk&) {}));
  EXPECT_TRUE(refuses([](MapChunk& c) { c.grid.origin.x() += 1.0; }));
  EXPECT_TRUE(refuses([](MapChunk& c) { c.class_names.pop_back(); }));
  EXPECT_TRUE(refuses([](MapChunk& c) { c.count += 1; }));
  EXPECT_TRUE(refuses([](MapChunk& c) { c.runs[0].length += 1'000'000; })) << "beyond the grid";
  EXPECT_TRUE(refuses([](MapChunk& c) { c.first_voxel -= 10; })) << "overlapping runs";
  EXPECT_TRUE(refuses([](MapChunk& c) { c.runs[0].class_index ^= 1; })) << "another digest";
}

TEST(VoxelMap, VersionNamesEveryPartOfTheMap) {
  const VoxelMap map = random_map(1, {6, 5, 4}, 0.5);
  const auto differs = [&](auto change) {
    VoxelMap changed = map;
    change(changed);
    return changed.compute_version() != map.version;
  };
  EXPECT_FALSE(differs([](VoxelMap&) {}));
  EXPECT_TRUE(differs([](VoxelMap& m) { m.grid.origin.y() += 0.25; }));
  EXPECT_TRUE(differs([](VoxelMap& m) { m.grid.resolution = 0.5; }));
  EXPECT_TRUE(differs([](VoxelMap& m) { std::swap(m.grid.size.x(), m.grid.size.y()); }));
  EXPECT_TRUE(differs([](VoxelMap& m) { m.class_names[1] = "lava"; }));
  EXPECT_TRUE(differs(
      [](VoxelMap& m) { m.labels[7] = m.labels[7] == VoxelLabel::Free ? VoxelLabel::Occupied : VoxelLabel::Free; }));
  EXPECT_TRUE(differs([](VoxelMap& m) { m.classes[7] ^= 1; }));
}

}  // namespace
}  // namespace tern
