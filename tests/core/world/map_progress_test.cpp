#include "core/world/map_progress.h"

#include <gtest/gtest.h>

namespace tern {
namespace {

MapChunk chunk(int index, int count, std::uint64_t version = 1) {
  MapChunk chunk;
  chunk.version = version;
  chunk.index = index;
  chunk.count = count;
  return chunk;
}

TEST(MapProgress, OfALargeMapSaysHowMuchHasArrivedAndHowLongItTakes) {
  MapProgress progress;
  EXPECT_EQ(progress.missing(), "a semantic map");
  EXPECT_FALSE(progress.is_complete());
  for (const int index : {7, 8, 9, 8}) progress.add(chunk(index, 500));
  EXPECT_EQ(progress.missing(), "a semantic map (3 of 500 chunks, all take up to 30 s)");
  for (int index = 0; index < 500; ++index) progress.add(chunk(index, 500));
  EXPECT_TRUE(progress.is_complete());
  progress.add(chunk(0, 600, 2));
  EXPECT_EQ(progress.missing(), "a semantic map (1 of 600 chunks, all take up to 36 s)") << "another map";
}

TEST(MapProgress, OfASmallMapNeedsNoNumbers) {
  MapProgress progress;
  progress.add(chunk(0, 2));
  EXPECT_EQ(progress.missing(), "a semantic map");
  progress.add(chunk(1, 2));
  EXPECT_TRUE(progress.is_complete());
  EXPECT_EQ(progress.rotation(), kMapChunkTime * 2);
}

}  // namespace
}  // namespace tern
