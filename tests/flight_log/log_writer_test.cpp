#include "flight_log/log_writer.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <filesystem>
#include <fstream>
#include <lcm/lcm-cpp.hpp>

#include "flight_log/log_format.h"
#include "flight_log/log_reader.h"
#include "tests/support/full_disk.h"
#include "tests/support/temp_folder.h"

namespace tern {
namespace {

std::vector<std::uint8_t> bytes(std::size_t n, std::uint8_t first = 0) {
  std::vector<std::uint8_t> data(n);
  for (std::size_t i = 0; i < n; ++i) data[i] = static_cast<std::uint8_t>(first + i);
  return data;
}

LogWriter open_or_die(const std::string& path, std::int64_t rotate_bytes = 0) {
  auto writer = LogWriter::open(path, rotate_bytes);
  EXPECT_TRUE(writer.has_value());
  return std::move(*writer);
}

std::vector<LogEvent> read_all(const std::string& path) {
  auto reader = LogReader::open(path);
  EXPECT_TRUE(reader.has_value());
  std::vector<LogEvent> events;
  while (auto event = reader->next()) events.push_back(std::move(*event));
  EXPECT_EQ(reader->damage().places, 0);
  EXPECT_EQ(reader->damage().missing, 0);
  return events;
}

RC_GTEST_PROP(LogWriter, LcmsOwnReaderReadsBackWhatWasWritten, ()) {
  const auto sizes = *rc::gen::container<std::vector<std::uint16_t>>(rc::gen::inRange<std::uint16_t>(0, 5000));
  const TempFolder folder;
  const std::string path = folder.file("a.lcm");
  {
    LogWriter writer = open_or_die(path);
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      writer.append("CHANNEL_" + std::to_string(i % 7), 1'000'000'000'000'000 + static_cast<std::int64_t>(i),
                    bytes(sizes[i], static_cast<std::uint8_t>(i)));
    }
  }
  lcm::LogFile log(path, "r");
  RC_ASSERT(log.good());
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const lcm::LogEvent* event = log.readNextEvent();
    RC_ASSERT(event != nullptr);
    RC_ASSERT(event->eventnum == static_cast<std::int64_t>(i));
    RC_ASSERT(event->timestamp == 1'000'000'000'000'000 + static_cast<std::int64_t>(i));
    RC_ASSERT(event->channel == "CHANNEL_" + std::to_string(i % 7));
    const auto* data = static_cast<const std::uint8_t*>(event->data);
    RC_ASSERT(std::vector<std::uint8_t>(data, data + event->datalen) == bytes(sizes[i], static_cast<std::uint8_t>(i)));
  }
  RC_ASSERT(log.readNextEvent() == nullptr);
}

TEST(LogWriter, NamesPartsBeforeTheExtension) {
  EXPECT_EQ(log_part_path("a/flight.lcm", 0), "a/flight.lcm");
  EXPECT_EQ(log_part_path("a/flight.lcm", 1), "a/flight.001.lcm");
  EXPECT_EQ(log_part_path("a.b/flight", 12), "a.b/flight.012");
}

TEST(LogWriter, FlushesNothingLessThanAllThatWaits) {
  const TempFolder folder;
  const std::string path = folder.file("a.lcm");
  LogWriter writer = open_or_die(path);
  writer.append("A", 1, bytes(10));
  writer.append("B", 2, bytes(20));
  ASSERT_TRUE(writer.flush());
  EXPECT_EQ(read_all(path).size(), 2U);
  EXPECT_EQ(writer.counters().written, 2);
  EXPECT_EQ(writer.counters().bytes, static_cast<std::int64_t>(std::filesystem::file_size(path)));
}

TEST(LogWriter, PartsOneAfterTheOtherAreOneLogAgain) {
  const TempFolder folder;
  const std::string path = folder.file("a.lcm");
  {
    LogWriter writer = open_or_die(path, 1'000);
    for (int i = 0; i < 100; ++i) {
      writer.append("A", i, bytes(100));
      ASSERT_TRUE(writer.flush());
    }
    EXPECT_EQ(writer.counters().parts, 13);  // a part takes 8 events of 129 bytes to reach 1000
  }
  std::ofstream joined(folder.file("joined.lcm"), std::ios::binary);
  for (int part = 0; part < 13; ++part) {
    const std::string file = log_part_path(path, part);
    ASSERT_TRUE(std::filesystem::exists(file)) << file;
    EXPECT_LE(std::filesystem::file_size(file), 1'000U + 129U);
    joined << std::ifstream(file, std::ios::binary).rdbuf();
  }
  joined.close();
  const auto events = read_all(folder.file("joined.lcm"));
  ASSERT_EQ(events.size(), 100U);
  EXPECT_EQ(events.back().number, 99);
}

TEST(LogWriter, NeverOverwritesAnEarlierLog) {
  const TempFolder folder;
  const std::string path = folder.file("a.lcm");
  { open_or_die(path).append("FIRST", 1, bytes(1)); }
  { open_or_die(path).append("SECOND", 2, bytes(1)); }
  EXPECT_EQ(read_all(path).at(0).channel, "FIRST");
  EXPECT_EQ(read_all(log_part_path(path, 1)).at(0).channel, "SECOND");
}

TEST(LogWriter, NamesThePathThatCannotBeWritten) {
  const auto writer = LogWriter::open("/nowhere/a.lcm", 0);
  ASSERT_FALSE(writer);
  EXPECT_NE(writer.error().message.find("/nowhere/a.lcm"), std::string::npos);
}

TEST(LogWriter, AFullDiskCostsWholeEventsAndIsSaid) {
  const TempFolder folder;
  const std::string path = folder.file("a.lcm");
  LogWriter writer = open_or_die(path);
  writer.append("A", 1, bytes(500));
  ASSERT_TRUE(writer.flush());
  {
    const FullDisk disk(800);
    writer.append("A", 2, bytes(500));
    const auto flushed = writer.flush();
    ASSERT_FALSE(flushed);
    EXPECT_NE(flushed.error().message.find(path), std::string::npos);
  }
  EXPECT_EQ(writer.counters().unwritten, 1);
  writer.append("A", 3, bytes(500));
  ASSERT_TRUE(writer.flush());
  auto reader = LogReader::open(path);
  ASSERT_TRUE(reader);
  EXPECT_EQ(reader->next()->received_us, 1);
  EXPECT_EQ(reader->next()->received_us, 3);
  EXPECT_FALSE(reader->next());
  EXPECT_EQ(reader->damage().bytes, 0);
  EXPECT_EQ(reader->damage().missing, 1);
}

}  // namespace
}  // namespace tern
