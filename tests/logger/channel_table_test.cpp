#include "logger/records/channel_table.h"

#include <gtest/gtest.h>

#include "messages/goal.h"
#include "runtime/channels.h"

namespace tern {
namespace {

Bytes goal(std::int64_t epoch, std::int64_t sequence) {
  Goal goal;
  goal.header = {{epoch, sequence}, UTime{1'000'000}};
  goal.id = 1;
  return encode(goal);
}

ChannelCount count_of(const std::vector<Bytes>& messages, const std::string& channel = "GOAL") {
  ChannelTable table;
  for (const Bytes& message : messages) table.add(channel, message);
  return table.counts().at(channel);
}

TEST(ChannelTable, KnowsEveryChannelOfTern) {
  for (const char* channel :
       {channels::kUavState, channels::kSetpoint, channels::kObstacleObservations, channels::kDeclaredMotions,
        channels::kPredictions, channels::kSemanticMap, channels::kGoal, channels::kHorizonRequest, channels::kPlan,
        channels::kPlanTiming, channels::kSearchView, channels::kHeartbeat, channels::kConfiguration,
        channels::kObstacleTruth, channels::kFlightResult}) {
    EXPECT_NE(find_head_decoder(channel), nullptr) << channel;
  }
  EXPECT_EQ(find_head_decoder("SOMEONE_ELSES"), nullptr);
}

TEST(ChannelTable, CountsGapsInASendersNumbersAsLost) {
  EXPECT_EQ(count_of({goal(1, 1), goal(1, 2), goal(1, 3)}).lost, 0);
  EXPECT_EQ(count_of({goal(1, 1), goal(1, 4)}).lost, 2);
}

TEST(ChannelTable, ALateJoinerAndARestartedSenderLostNothing) {
  EXPECT_EQ(count_of({goal(1, 100), goal(1, 101)}).lost, 0);
  EXPECT_EQ(count_of({goal(1, 7), goal(2, 1), goal(2, 2)}).lost, 0);
}

TEST(ChannelTable, SendersAreCountedApart) {
  EXPECT_EQ(count_of({goal(1, 1), goal(2, 1), goal(1, 2), goal(2, 3)}).lost, 1);
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
  table.add("GOAL_7", goal(1, 1));
  table.add("GOAL_7", goal(1, 3));
  table.add("GOAL", goal(1, 5));
  table.add("GOAL", goal(1, 7));
  EXPECT_EQ(table.counts().at("GOAL_7").lost, 1);
  EXPECT_EQ(table.counts().at("GOAL").lost, 0);
}

}  // namespace
}  // namespace tern
