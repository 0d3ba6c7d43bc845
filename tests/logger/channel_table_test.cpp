#include "logger/channel_table.h"

#include <gtest/gtest.h>

#include "messages/codec.h"

namespace tern {
namespace {

constexpr UTime kNow{1'000'000};

Bytes goal(std::int64_t epoch, std::int64_t sequence) {
  Goal goal;
  goal.header = {{epoch, sequence}, UTime{1'000'000}};
  goal.id = 1;
  return encode(goal);
}

ChannelCount count_of(const std::vector<Bytes>& messages, const std::string& channel = "GOAL") {
  ChannelTable table;
  for (const Bytes& message : messages) table.add(channel, kNow, message);
  return table.counts().at(channel);
}

/// One sender's messages with these numbers.
std::vector<Bytes> goals(std::int64_t epoch, const std::vector<std::int64_t>& numbers) {
  std::vector<Bytes> messages;
  for (const std::int64_t k : numbers) messages.push_back(goal(epoch, k));
  return messages;
}

TEST(ChannelTable, KnowsEveryChannelOfTern) {
  for_each_channel([](const auto& channel) { EXPECT_NE(find_head_decoder(channel.name), nullptr) << channel.name; });
  EXPECT_EQ(find_head_decoder("SOMEONE_ELSES"), nullptr);
}

TEST(ChannelTable, CountsGapsInASendersNumbersAsLost) {
  EXPECT_EQ(count_of(goals(1, {1, 2, 3, 4, 5})).lost, 0);
  EXPECT_EQ(count_of(goals(1, {1, 4, 5, 6, 7})).lost, 2);
}

TEST(ChannelTable, ALateJoinerAndARestartedSenderLostNothing) {
  std::vector<Bytes> messages = goals(1, {100, 101, 102, 103, 104});
  for (const Bytes& message : goals(2, {1, 2, 3, 4, 5})) messages.push_back(message);
  EXPECT_EQ(count_of(messages).lost, 0);
}

TEST(ChannelTable, SendersAreCountedApart) {
  std::vector<Bytes> messages;
  for (int k = 1; k <= 5; ++k) {
    messages.push_back(goal(1, k));
    messages.push_back(goal(2, k < 3 ? k : k + 1));
  }
  EXPECT_EQ(count_of(messages).lost, 1);
}

TEST(ChannelTable, AForgedNumberIsNoLoss) {
  std::vector<Bytes> messages = goals(1, {1, 2, 3, 4, 5});
  messages.push_back(goal(1, 1'000'000));
  for (const Bytes& message : goals(1, {6, 7, 8})) messages.push_back(message);
  EXPECT_EQ(count_of(messages).lost, 0);
}

TEST(ChannelTable, CountsWhatTernWouldRefuse) {
  Bytes broken = goal(1, 1);
  broken.pop_back();
  const ChannelCount count = count_of({broken, goal(1, 1)});
  EXPECT_EQ(count.received, 2);
  EXPECT_EQ(count.refused, 1);
}

TEST(ChannelTable, TakesForeignChannelsAsTheyAre) {
  const ChannelCount count = count_of({Bytes(10), Bytes(20)}, "SOMEONE_ELSES");
  EXPECT_EQ(count.received, 2);
  EXPECT_EQ(count.bytes, 30);
  EXPECT_EQ(count.refused, 0);
}

TEST(ChannelTable, KnowsAVehiclesChannelsByTheirSuffix) {
  ChannelTable table("_7");
  for (const Bytes& message : goals(1, {1, 3, 4, 5, 6})) {
    table.add("GOAL_7", kNow, message);
    table.add("GOAL", kNow, message);
  }
  EXPECT_EQ(table.counts().at("GOAL_7").lost, 1);
  EXPECT_EQ(table.counts().at("GOAL").lost, 0);
}

}  // namespace
}  // namespace tern
