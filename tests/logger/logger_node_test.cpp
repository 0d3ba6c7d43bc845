#include "logger/app/logger_node.h"

#include <gtest/gtest.h>

#include <lcm/lcm-cpp.hpp>

#include "flight_log/log_reader.h"
#include "messages/codec.h"
#include "runtime/process.h"
#include "runtime/virtual_runner.h"
#include "tests/support/full_disk.h"
#include "tests/support/temp_folder.h"

namespace tern {
namespace {

LoggerConfig configured(const std::string& yaml) {
  ConfigDocument document = ConfigDocument::parse(yaml, "test.yaml");
  return read_logger_config(document.root().section("logger"));
}

TEST(Logger, ReadsItsSectionStrictly) {
  EXPECT_EQ(configured("logger: {rotate_mb: 2}").rotate_bytes, 2'000'000);
  EXPECT_THROW(configured("logger: {rotate_mb: -1}"), ConfigError);
  EXPECT_THROW(configured("logger: {rotate: 1}"), ConfigError);
}

TEST(Logger, RefusesAPlaceThatCannotBeWritten) {
  VirtualRunner runner;
  EXPECT_THROW(LoggerNode(runner.observer(), LoggerConfig{}, "/nowhere/a.lcm"), ConfigError);
}

TEST(Logger, RecordsEveryMessageOfEveryChannel) {
  const TempFolder folder;
  const std::string path = folder.file("a.lcm");
  VirtualRunner runner;
  auto& logger = dynamic_cast<LoggerNode&>(
      runner.start("tern-logger", [&](Bus& bus) { return std::make_unique<LoggerNode>(bus, LoggerConfig{}, path); }));
  Bus& sender = runner.observer();
  for (int i = 0; i < 50; ++i) {
    Goal goal;
    goal.id = i + 1;
    sender.publish(channels::kGoal, goal);
    sender.publish(Channel<Goal>{"EXTRA"}, goal);
    runner.run(runner.now() + Duration{50'000});
  }
  EXPECT_EQ(logger.table().counts().at("GOAL").received, 50);
  EXPECT_EQ(logger.table().counts().at("GOAL").lost, 0);
  EXPECT_EQ(logger.table().counts().at("EXTRA").received, 50);
  std::int64_t received = 0;
  for (const auto& [channel, count] : logger.table().counts()) received += count.received;
  runner.stop("tern-logger");

  auto reader = LogReader::open(path);
  ASSERT_TRUE(reader);
  std::int64_t events = 0, goals = 0;
  while (const auto event = reader->next()) {
    ++events;
    if (event->channel != channels::kGoal.name) continue;
    const auto goal = decode<Goal>(event->data);
    ASSERT_TRUE(goal);
    EXPECT_EQ(goal->id, ++goals);
  }
  EXPECT_EQ(goals, 50);
  EXPECT_EQ(events, received);
  EXPECT_EQ(reader->damage().bytes, 0);
}

TEST(Logger, IsReadyWhenItHasTheConfigurationOfEveryProcessThatItHears) {
  const TempFolder folder;
  VirtualRunner runner;
  const auto& logger = dynamic_cast<LoggerNode&>(runner.start("tern-logger", [&](Bus& bus) {
    return std::make_unique<LoggerNode>(bus, LoggerConfig{}, folder.file("a.lcm"));
  }));
  Bus& sender = runner.observer();
  const auto beat = [&](const std::string& process) {
    Heartbeat heartbeat;
    heartbeat.process = process;
    heartbeat.build_id = "b";
    sender.publish(channels::kHeartbeat, heartbeat);
    runner.run(runner.now() + Duration{100'000});
  };
  beat("a_detector");
  EXPECT_EQ(logger.health().state, ProcessState::Ready) << logger.health().waiting_for;
  beat("tern-planner");
  EXPECT_EQ(logger.health().state, ProcessState::Waiting);
  EXPECT_EQ(logger.health().waiting_for, "CONFIGURATION of tern-planner");
  ConfigurationReport report;
  report.process = "tern-planner";
  report.build_id = "b";
  report.platform = "p";
  report.hash = configuration_hash("");
  sender.publish(channels::kConfiguration, report);
  runner.run(runner.now() + Duration{100'000});
  EXPECT_EQ(logger.health().state, ProcessState::Ready) << logger.health().waiting_for;
}

TEST(Logger, DoesNotWaitForTheConfigurationOfOneThatIsGone) {
  const TempFolder folder;
  VirtualRunner runner;
  const auto& logger = dynamic_cast<LoggerNode&>(runner.start("tern-logger", [&](Bus& bus) {
    return std::make_unique<LoggerNode>(bus, LoggerConfig{}, folder.file("a.lcm"));
  }));
  Heartbeat heartbeat;
  heartbeat.process = "tern-mapper";
  heartbeat.build_id = "b";
  runner.observer().publish(channels::kHeartbeat, heartbeat);
  runner.run(runner.now() + Duration{2'000'000});
  EXPECT_EQ(logger.health().state, ProcessState::Waiting);
  runner.run(runner.now() + Duration{1'000'000});
  EXPECT_EQ(logger.health().state, ProcessState::Ready);
}

TEST(Logger, SaysAtOnceAndForGoodThatAFullDiskLostMessages) {
  const TempFolder folder;
  VirtualRunner runner;
  const auto& logger = dynamic_cast<LoggerNode&>(runner.start("tern-logger", [&](Bus& bus) {
    return std::make_unique<LoggerNode>(bus, LoggerConfig{}, folder.file("a.lcm"));
  }));
  std::vector<Heartbeat> heard;
  runner.observer().subscribe(channels::kHeartbeat, [&heard](const Heartbeat& beat) { heard.push_back(beat); });
  Goal goal;
  const auto publish = [&] {
    goal.id += 1;
    runner.observer().publish(channels::kGoal, goal);
    runner.run(runner.now() + Duration{1'000'000});
  };
  publish();
  EXPECT_EQ(logger.health().state, ProcessState::Ready);
  {
    const FullDisk disk(100);
    publish();
  }
  EXPECT_EQ(heard.back().state, ProcessState::Failed);
  EXPECT_NE(heard.back().waiting_for.find("are not in the log: " + folder.file("a.lcm")), std::string::npos)
      << heard.back().waiting_for;
  const std::int64_t lost = logger.counters().unwritten;
  publish();
  EXPECT_EQ(logger.counters().unwritten, lost) << "it writes again";
  EXPECT_EQ(heard.back().state, ProcessState::Failed) << "the recording stays incomplete";
}

TEST(Logger, TellsAtItsEndThatItsLastFlushFailed) {
  const TempFolder folder;
  VirtualRunner runner;
  bool is_whole = true;
  runner.start("tern-logger", [&](Bus& bus) {
    return std::make_unique<LoggerNode>(bus, LoggerConfig{}, folder.file("a.lcm"), &is_whole);
  });
  runner.run(runner.now() + Duration{1'000'000});
  Goal goal;
  goal.id = 1;
  runner.observer().publish(channels::kGoal, goal);
  runner.run(runner.now() + Duration{1'000});
  {
    const FullDisk disk(100);
    runner.stop("tern-logger");
  }
  EXPECT_FALSE(is_whole);
  runner.start("tern-logger", [&](Bus& bus) {
    return std::make_unique<LoggerNode>(bus, LoggerConfig{}, folder.file("b.lcm"), &is_whole);
  });
  runner.stop("tern-logger");
  EXPECT_TRUE(is_whole);
}

/// Fragments can make a message of 256 MB, which LCM hands over.
TEST(Logger, LeavesOutWhatNoReaderTakesAndTheLogStaysWhole) {
  const TempFolder folder;
  const std::string path = folder.file("a.lcm");
  const auto lcm = std::make_shared<lcm::LCM>("memq://");
  const VirtualClock clock(UTime{1});
  Bus bus(lcm, clock, 1);
  {
    LoggerNode logger(bus, LoggerConfig{}, path);
    for (const std::size_t bytes : {std::size_t{10}, kLogMaxDataBytes, kLogMaxDataBytes + 1, std::size_t{20}}) {
      const std::vector<std::uint8_t> data(bytes);
      lcm->publish("EXTRA", data.data(), static_cast<unsigned>(bytes));
      lcm->handleTimeout(0);
    }
    bus.rethrow();
    EXPECT_EQ(logger.table().counts().at("EXTRA").received, 4);
    EXPECT_EQ(logger.counters().unwritten, 0);
  }
  auto reader = LogReader::open(path);
  ASSERT_TRUE(reader);
  std::vector<std::size_t> sizes;
  while (const auto event = reader->next()) sizes.push_back(event->data.size());
  EXPECT_EQ(sizes, (std::vector<std::size_t>{10, kLogMaxDataBytes, 20}));
  EXPECT_EQ(reader->damage().bytes, 0);
}

}  // namespace
}  // namespace tern
