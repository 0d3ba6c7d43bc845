#include "monitor/process_table.h"

#include <gtest/gtest.h>

namespace tern {
namespace {

Heartbeat beat(const std::string& process, std::int64_t epoch, std::int64_t received = 0) {
  Heartbeat heartbeat;
  heartbeat.process = process;
  heartbeat.header.name = {epoch, 1};
  heartbeat.state = ProcessState::Ready;
  heartbeat.channels["GOAL"].received = received;
  return heartbeat;
}

TEST(ProcessTable, CountsStartsBeyondTheFirst) {
  ProcessTable table;
  EXPECT_EQ(table.restarts(), 0);
  for (const std::int64_t epoch : {1, 1, 2, 2, 5}) table.add(beat("a", epoch), UTime{});
  table.add(beat("b", 3), UTime{});
  EXPECT_EQ(table.restarts(), 2);
  EXPECT_EQ(table.epoch_us("a"), 5);
}

TEST(ProcessTable, KeepsTheCountsOfAProcessThatDied) {
  ProcessTable table;
  table.add(beat("a", 1, 10), UTime{});
  table.add(beat("a", 1, 30), UTime{});
  table.add(beat("a", 2, 5), UTime{});
  table.add(beat("b", 1, 7), UTime{});
  EXPECT_EQ(table.messages().at("GOAL").received, 42);
}

TEST(ProcessTable, AddsRejectionsOfEveryReason) {
  Heartbeat heartbeat = beat("a", 1);
  heartbeat.channels["PLAN"].rejected[static_cast<int>(Rejection::Length)] = 2;
  heartbeat.channels["PLAN"].rejected[static_cast<int>(Rejection::Inconsistent)] = 3;
  heartbeat.channels["PLAN"].lost = 4;
  ProcessTable table;
  table.add(heartbeat, UTime{});
  EXPECT_EQ(table.messages().at("PLAN").rejected, 5);
  EXPECT_EQ(table.messages().at("PLAN").lost, 4);
}

TEST(ProcessTable, RemembersWhenAProcessWasHeard) {
  ProcessTable table;
  EXPECT_FALSE(table.heard("a"));
  EXPECT_FALSE(table.epoch_us("a"));
  table.add(beat("a", 1), UTime{10});
  table.add(beat("b", 1), UTime{20});
  EXPECT_EQ(table.heard("a"), UTime{10});
}

TEST(ProcessTable, SaysWhoWaitsForWhat) {
  ProcessTable table;
  table.add(beat("a", 1), UTime{});
  EXPECT_EQ(table.waiting(), "");
  Heartbeat planner = beat("tern-planner", 1);
  planner.state = ProcessState::Waiting;
  planner.waiting_for = "a map";
  table.add(planner, UTime{});
  EXPECT_EQ(table.waiting(), "tern-planner: a map");
}

}  // namespace
}  // namespace tern
