#include "semantic_mapper/app/mapper_node.h"

#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "messages/codec.h"
#include "runtime/virtual_runner.h"
#include "tests/support/voxel_maps.h"

namespace tern {
namespace {

/// A mapper, and a test that receives its messages.
class MapperNodeTest : public ::testing::Test {
 protected:
  struct Arrival {
    UTime at;
    MapChunk chunk;
  };

  void start(const VoxelMap& map) {
    runner_.start("tern-mapper", [&](Bus& bus) { return std::make_unique<MapperNode>(bus, map); });
    runner_.observer().subscribe(channels::kSemanticMap, [this](const MapChunk& chunk) {
      arrivals_.push_back({runner_.now(), chunk});
      const auto done = assembler_.add(chunk);
      ASSERT_TRUE(done);
      if (*done) maps_.push_back(assembler_.take());
    });
  }

  VirtualRunner runner_;
  std::vector<Arrival> arrivals_;
  MapAssembler assembler_;
  std::vector<VoxelMap> maps_;
};

VoxelMap ragged_map(const Eigen::Vector3i& size) {
  VoxelMap map = support::free_map(size);
  Rng rng(1);
  support::sprinkle(map, rng, 0.5, VoxelLabel::Occupied);
  return map;
}

TEST_F(MapperNodeTest, ASmallMapComesWholeOnceASecond) {
  VoxelMap map = support::free_map({300, 24, 16});
  support::paint(map, {60, 4, 0}, {119, 11, 15}, VoxelLabel::Attractive);
  start(map);
  const UTime began = runner_.now();
  runner_.run(began + Duration{4'500'000});
  ASSERT_EQ(arrivals_.size(), 5u);
  for (std::size_t i = 0; i < arrivals_.size(); ++i)
    EXPECT_EQ((arrivals_[i].at - began).us, 1'000'000 * static_cast<int>(i));
  ASSERT_EQ(maps_.size(), 1u);
  EXPECT_EQ(maps_[0].labels, map.labels);
}

TEST_F(MapperNodeTest, ALargeMapGoesRoundAtItsShareOfTheNetwork) {
  const VoxelMap map = ragged_map({200, 200, 30});
  start(map);
  const UTime began = runner_.now();
  runner_.run(began + Duration{10'000'000});
  ASSERT_EQ(maps_.size(), 1u);
  EXPECT_EQ(maps_[0].version, map.version);
  std::int64_t bytes = 0;
  for (std::size_t i = 0; i < arrivals_.size(); ++i) {
    const auto size = static_cast<std::int64_t>(encode(arrivals_[i].chunk).size());
    EXPECT_LE(size, kMaxMessageBytes);
    bytes += size;
    if (i > 0) {
      EXPECT_GE((arrivals_[i].at - arrivals_[i - 1].at).us, kPacing.us);
    }
  }
  EXPECT_LE(bytes, 10 * kMapBytesPerSecond + 2 * kMaxMessageBytes);
  EXPECT_GE(bytes, 9 * kMapBytesPerSecond) << "it uses its share";
}

TEST_F(MapperNodeTest, SaysHowLongALargeMapTakes) {
  const auto text_of = [](const VoxelMap& map) {
    VirtualRunner runner;
    const Node& node = runner.start("tern-mapper", [&](Bus& bus) { return std::make_unique<MapperNode>(bus, map); });
    return node.health().waiting_for;
  };
  EXPECT_EQ(text_of(ragged_map({60, 60, 20})), "");
  EXPECT_EQ(text_of(ragged_map({200, 200, 30})), "the map of 4 MB in 76 chunks takes 4 s, at 1 MB/s");
}

TEST_F(MapperNodeTest, ALateJoinerGetsASmallMapWithinTwoSeconds) {
  const VoxelMap map = ragged_map({60, 60, 20});
  runner_.start("tern-mapper", [&](Bus& bus) { return std::make_unique<MapperNode>(bus, map); });
  runner_.run(runner_.now() + Duration{5'333'000});
  MapAssembler late;
  std::optional<UTime> done;
  runner_.observer().subscribe(channels::kSemanticMap, [&](const MapChunk& chunk) {
    if (late.add(chunk).value()) done = runner_.now();
  });
  const UTime joined = runner_.now();
  runner_.run(joined + Duration{2'000'000});
  ASSERT_TRUE(done);
}

TEST_F(MapperNodeTest, RefusesAMapOfTooManyChunks) {
  VoxelMap map = support::free_map({400, 300, 300});
  for (std::size_t i = 0; i < map.labels.size(); i += 2) map.labels[i] = VoxelLabel::Occupied;
  map.version = map.compute_version();
  VirtualRunner runner;
  EXPECT_THROW(runner.start("tern-mapper", [&](Bus& bus) { return std::make_unique<MapperNode>(bus, map); }),
               std::invalid_argument);
}

}  // namespace
}  // namespace tern
