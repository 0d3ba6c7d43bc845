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

constexpr Duration kBeat{500'000};

TEST(ProcessTable, CountsStartsBeyondTheFirst) {
  ProcessTable table;
  EXPECT_EQ(table.restarts(), 0);
  UTime now;
  for (const std::int64_t epoch : {1, 1, 2, 2, 5, 5}) table.add(beat("a", epoch), now = now + kBeat);
  table.add(beat("b", 3), now);
  EXPECT_EQ(table.restarts(), 2);
  EXPECT_TRUE(table.concurrent().empty());
  EXPECT_EQ(table.concurrent_now(now), "");
}

TEST(ProcessTable, ASecondProcessBesideTheFirstIsSaidAndIsNoRestart) {
  ProcessTable table;
  UTime now;
  for (int k = 0; k < 10; ++k) {
    now = now + kBeat;
    table.add(beat("a", 1), now);
    if (3 <= k && k < 7) table.add(beat("a", 2), now);
    EXPECT_EQ(table.concurrent_now(now), 4 <= k && k < 9 ? "2 a" : "") << k;
  }
  EXPECT_EQ(table.restarts(), 0);
  EXPECT_EQ(table.epoch_us("a"), 1);
  EXPECT_EQ(table.concurrent(), (std::map<std::string, int>{{"a", 2}}));
  EXPECT_EQ(table.concurrent_now(now), "");
}

TEST(ProcessTable, AnotherStartCountsOnceTheFirstIsSilentAndItWasHeardTwice) {
  ProcessTable table;
  UTime now;
  table.add(beat("a", 7), now);
  table.add(beat("a", 7), now = now + kBeat);
  table.add(beat("a", 9), now = now + kBeat);
  EXPECT_EQ(table.epoch_us("a"), 7);
  table.add(beat("a", 9), now = now + kHeartbeatTimeout);
  EXPECT_EQ(table.epoch_us("a"), 9);
  EXPECT_EQ(table.last_heartbeat("a", 7), UTime{} + kBeat);
}

TEST(ProcessTable, WhatWasHeardOnceIsNoiseAndIsForgotten) {
  ProcessTable table;
  UTime now;
  Heartbeat absurd = beat("tern-qlanner", 1, 1'000'000'000'000);
  absurd.state = ProcessState::Waiting;
  table.add(absurd, now);
  table.add(beat("a", 99, 1'000'000'000'000), now);
  for (int k = 0; k < 5; ++k) table.add(beat("a", 1, 30), now = now + kBeat);
  EXPECT_EQ(table.waiting(), "");
  EXPECT_EQ(table.restarts(), 0);
  EXPECT_EQ(table.epoch_us("a"), 1);
  EXPECT_EQ(table.messages().at("GOAL").received, 30);
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
  EXPECT_FALSE(table.last_heartbeat("a", 1));
  EXPECT_EQ(table.epoch_us("a"), 0);
  table.add(beat("a", 1), UTime{10});
  table.add(beat("b", 1), UTime{20});
  EXPECT_EQ(table.last_heartbeat("a", 1), UTime{10});
  EXPECT_FALSE(table.last_heartbeat("a", 2));
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
