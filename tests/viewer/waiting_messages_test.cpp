// A slow client of Foxglove loses its oldest messages, but no map.
#include "viewer/foxglove/waiting_messages.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tern::foxglove {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr std::size_t kMost = 100;

WaitingMessage message(const std::string& name, std::size_t bytes, std::optional<std::uint32_t> latched_for = {}) {
  return {name, std::make_shared<const std::string>(bytes - name.size(), '.'), latched_for};
}

std::vector<std::string> taken(WaitingMessages& waiting) {
  std::vector<std::string> names;
  while (const auto first = waiting.take()) names.push_back(first->head);
  return names;
}

TEST(WaitingMessages, AreSentInTheirOrder) {
  WaitingMessages waiting(kMost);
  EXPECT_EQ(waiting.add(message("a", 50)), 0);
  EXPECT_EQ(waiting.add(message("map", 500, 7)), 0);
  EXPECT_EQ(waiting.add(message("b", 50)), 0);
  EXPECT_THAT(taken(waiting), ElementsAre("a", "map", "b"));
  EXPECT_FALSE(waiting.take());
}

/// One subscription to goal, map and regions: the goal is being written, the others wait.
TEST(WaitingMessages, OfALatchedChannelAreKeptWhateverTheirSizeAndWhateverFollows) {
  WaitingMessages waiting(kMost);
  EXPECT_EQ(waiting.add(message("map", 5'000, 2)), 0);
  EXPECT_EQ(waiting.add(message("regions", 3'000, 3)), 0);
  for (int k = 0; k < 20; ++k) waiting.add(message("odometry " + std::to_string(k), 40));
  EXPECT_THAT(taken(waiting), ElementsAre("map", "regions", "odometry 18", "odometry 19"));
}

TEST(WaitingMessages, DropTheOldestBeyondTheBytesButNeverTheNewest) {
  WaitingMessages waiting(kMost);
  EXPECT_EQ(waiting.add(message("a", 60)), 0);
  EXPECT_EQ(waiting.add(message("b", 40)), 0) << "at the limit";
  EXPECT_EQ(waiting.add(message("c", 50)), 1);
  EXPECT_EQ(waiting.add(message("large", 101)), 2);
  EXPECT_THAT(taken(waiting), ElementsAre("large"));
  EXPECT_EQ(waiting.add(message("d", 60)), 0) << "what was taken waits no longer";
  EXPECT_EQ(waiting.add(message("e", 40)), 0);
}

TEST(WaitingMessages, OfALatchedChannelGiveWayToANewerOneOfTheirSubscription) {
  WaitingMessages waiting(kMost);
  waiting.add(message("map 1 for 2", 500, 2));
  waiting.add(message("map 1 for 9", 500, 9));
  waiting.add(message("a", 50));
  EXPECT_EQ(waiting.add(message("map 2 for 2", 700, 2)), 1);
  EXPECT_THAT(taken(waiting), ElementsAre("map 2 for 2", "map 1 for 9", "a"));
  EXPECT_EQ(waiting.add(message("map 3 for 2", 700, 2)), 0);
}

TEST(WaitingMessages, AreBoundedForAClientThatSubscribesAgainAndAgain) {
  WaitingMessages waiting(kMost);
  for (std::uint32_t subscription = 0; subscription < 1'000; ++subscription) {
    waiting.add(message("map", 500, subscription));
    waiting.end(subscription);
    waiting.end(subscription);
  }
  EXPECT_THAT(taken(waiting), IsEmpty());
}

}  // namespace
}  // namespace tern::foxglove
