#include "flight_log/log_reader.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "flight_log/log_writer.h"
#include "tests/support/temp_folder.h"

namespace tern {
namespace {

constexpr std::size_t kDataBytes = 50;
constexpr std::size_t kEventBytes = kLogHeadBytes + 1 + kDataBytes;

std::string make_log(const TempFolder& folder, int events) {
  const std::string path = folder.file("a.lcm");
  auto writer = LogWriter::open(path, 0);
  for (int i = 0; i < events; ++i) {
    writer->append("A", 1'000 + i, std::vector<std::uint8_t>(kDataBytes, static_cast<std::uint8_t>(i)));
  }
  return path;
}

std::string slurp(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

struct Reading {
  std::vector<LogEvent> events;
  LogDamage damage;
};

Reading read(const TempFolder& folder, const std::string& bytes) {
  const std::string path = folder.file("damaged.lcm");
  std::ofstream(path, std::ios::binary) << bytes;
  auto reader = LogReader::open(path);
  Reading reading;
  while (auto event = reader->next()) reading.events.push_back(std::move(*event));
  reading.damage = reader->damage();
  return reading;
}

TEST(LogReader, SaysWhyAFileCannotBeRead) {
  const auto reader = LogReader::open("/nowhere.lcm");
  ASSERT_FALSE(reader);
  EXPECT_NE(reader.error().message.find("/nowhere.lcm"), std::string::npos);
}

TEST(LogReader, WhatTheDiskDoesNotGiveIsDamage) {
  const TempFolder folder;
  auto reader = LogReader::open(std::filesystem::path(folder.file("any")).parent_path().string());
  ASSERT_TRUE(reader) << "a folder opens, and no read of it succeeds";
  EXPECT_FALSE(reader->next());
  EXPECT_TRUE(reader->damage().truncated);
  EXPECT_EQ(reader->damage().places, 1);
}

TEST(LogReader, AnEmptyFileIsAnEmptyLog) {
  const TempFolder folder;
  const Reading reading = read(folder, "");
  EXPECT_TRUE(reading.events.empty());
  EXPECT_EQ(reading.damage.places, 0);
  EXPECT_FALSE(reading.damage.truncated);
}

TEST(LogReader, ATruncatedLogEndsAtItsLastWholeEvent) {
  const TempFolder folder;
  const std::string log = slurp(make_log(folder, 10));
  for (std::size_t cut = 1; cut < kEventBytes; ++cut) {
    const Reading reading = read(folder, log.substr(0, log.size() - cut));
    ASSERT_EQ(reading.events.size(), 9U) << cut;
    EXPECT_TRUE(reading.damage.truncated);
    EXPECT_EQ(reading.damage.bytes, static_cast<std::int64_t>(kEventBytes - cut));
  }
}

TEST(LogReader, ALengthThatCrashesLcmsReaderCostsOneEvent) {
  const TempFolder folder;
  std::string log = slurp(make_log(folder, 10));
  log.replace(3 * kEventBytes + 24, 4, "\x7f\xff\xff\xff");
  const Reading reading = read(folder, log);
  EXPECT_EQ(reading.events.size(), 9U);
  EXPECT_EQ(reading.damage.places, 1);
  EXPECT_EQ(reading.damage.bytes, static_cast<std::int64_t>(kEventBytes));
  EXPECT_EQ(reading.damage.missing, 1);
  EXPECT_FALSE(reading.damage.truncated);
}

TEST(LogReader, ATimeBeyondAllClocksCostsOneEvent) {
  const TempFolder folder;
  const std::string log = slurp(make_log(folder, 10));
  for (const char first : {'\x7f', '\x80'}) {
    std::string damaged = log;
    damaged[3 * kEventBytes + 12] = first;
    const Reading reading = read(folder, damaged);
    EXPECT_EQ(reading.events.size(), 9U);
    EXPECT_EQ(reading.damage.places, 1);
    EXPECT_EQ(reading.damage.missing, 1);
  }
}

TEST(LogReader, APlausibleWrongLengthCostsOneEvent) {
  const TempFolder folder;
  std::string log = slurp(make_log(folder, 10));
  log[3 * kEventBytes + 27] = static_cast<char>(kDataBytes + 2 * kEventBytes + 5);
  EXPECT_EQ(read(folder, log).events.size(), 9U);
}

TEST(LogReader, AnEventBeforeRubbishIsKept) {
  const TempFolder folder;
  std::string log = slurp(make_log(folder, 10));
  log.insert(4 * kEventBytes, std::string(1'000, '\x55'));
  const Reading reading = read(folder, log);
  EXPECT_EQ(reading.events.size(), 10U);
  EXPECT_EQ(reading.damage.bytes, 1'000);
  EXPECT_EQ(reading.damage.missing, 0);
}

RC_GTEST_PROP(LogReader, DamageCostsNoMoreThanTheEventsItTouches, ()) {
  const TempFolder folder;
  const std::string whole = slurp(make_log(folder, 30));
  std::string log = whole;
  const auto at = *rc::gen::inRange<std::size_t>(0, log.size());
  const auto length = std::min(*rc::gen::inRange<std::size_t>(1, 300), log.size() - at);
  for (std::size_t i = at; i < at + length; ++i) log[i] = *rc::gen::arbitrary<char>();
  const Reading reading = read(folder, log);
  const std::size_t first = at / kEventBytes, last = (at + length - 1) / kEventBytes;
  for (std::size_t k = 0; k < 30; ++k) {
    if (k >= first && k <= last) continue;
    const bool found = std::any_of(reading.events.begin(), reading.events.end(), [k](const LogEvent& event) {
      return event.number == static_cast<std::int64_t>(k) &&
             event.data == std::vector<std::uint8_t>(kDataBytes, static_cast<std::uint8_t>(k));
    });
    RC_ASSERT(found);
  }
}

RC_GTEST_PROP(LogReader, SurvivesArbitraryBytes, (const std::vector<std::uint8_t>& noise)) {
  const TempFolder folder;
  const Reading reading = read(folder, std::string(noise.begin(), noise.end()));
  RC_ASSERT(reading.damage.bytes <= static_cast<std::int64_t>(noise.size()));
}

TEST(LogReader, ReadsWindowsLargerThanItsBuffer) {
  const TempFolder folder;
  const std::string path = folder.file("big.lcm");
  {
    auto writer = LogWriter::open(path, 0);
    for (int i = 0; i < 40; ++i)
      writer->append("BIG", i, std::vector<std::uint8_t>(300'000, static_cast<std::uint8_t>(i)));
  }
  auto reader = LogReader::open(path);
  int events = 0;
  while (const auto event = reader->next()) {
    EXPECT_EQ(event->data.size(), 300'000U);
    EXPECT_EQ(event->data.back(), events++);
  }
  EXPECT_EQ(events, 40);
}

}  // namespace
}  // namespace tern
