#include "campaign/records/flight_table.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "tests/campaign/some_flights.h"
#include "tests/support/temp_folder.h"

namespace tern {
namespace {

std::string text_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void append(const std::string& path, const std::string& text) { std::ofstream(path, std::ios::app) << text; }

FlightTable open(const std::string& file) {
  auto table = FlightTable::open(file, some_flight(1).identity);
  if (!table) throw std::runtime_error(table.error().message);
  return std::move(*table);
}

class FlightTableTest : public ::testing::Test {
 protected:
  void add(FlightTable& table, std::uint64_t seed) {
    const auto added = table.add(some_flight(seed), some_times(seed));
    ASSERT_TRUE(added) << added.error().message;
  }

  TempFolder folder_;
  std::string file_ = folder_.file("flights.csv");
};

TEST_F(FlightTableTest, HoldsWhatWasAddedWhenItIsOpenedAgain) {
  {
    FlightTable table = open(file_);
    add(table, 7), add(table, 2);
  }
  FlightTable table = open(file_);
  EXPECT_TRUE(table.has(7));
  EXPECT_TRUE(table.has(2));
  EXPECT_FALSE(table.has(1));
  EXPECT_EQ(to_cells(table.flights().records.at(7)), to_cells(some_flight(7)));
  EXPECT_EQ(table.flights().times.at(2).times, some_times(2).times);
}

TEST_F(FlightTableTest, SortedIsTheSameWhateverTheOrder) {
  {
    FlightTable table = open(file_);
    add(table, 3), add(table, 1), add(table, 2);
    ASSERT_TRUE(table.close_sorted());
  }
  const std::string other = folder_.file("other.csv");
  {
    FlightTable table = open(other);
    add(table, 2), add(table, 3), add(table, 1);
    ASSERT_TRUE(table.close_sorted());
  }
  EXPECT_EQ(text_of(file_), text_of(other));
  EXPECT_EQ(text_of(times_file(file_)), text_of(times_file(other)));
}

TEST_F(FlightTableTest, WhatADeadWriterLeftOfALineIsCutOff) {
  {
    FlightTable table = open(file_);
    add(table, 3);
  }
  const std::string whole = text_of(file_);
  append(file_, csv_line(to_cells(some_flight(4))).substr(0, 30));
  append(times_file(file_), csv_line(to_cells(some_times(4))));  // times without their flight
  {
    FlightTable table = open(file_);
    EXPECT_FALSE(table.has(4));
    EXPECT_FALSE(table.flights().times.contains(4));
    EXPECT_EQ(text_of(file_), whole);
    add(table, 4);
  }
  EXPECT_EQ(text_of(file_), whole + csv_line(to_cells(some_flight(4))));
}

TEST_F(FlightTableTest, RefusesAnotherCampaignAndSaysWhy) {
  {
    FlightTable table = open(file_);
    add(table, 1);
  }
  CampaignIdentity other = some_flight(1).identity;
  other.count = 300;
  const auto refused = FlightTable::open(file_, other);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("count 100 against 300"), std::string::npos) << refused.error().message;
}

TEST_F(FlightTableTest, IsHeldByOne) {
  FlightTable table = open(file_);
  const auto second = FlightTable::open(file_, some_flight(1).identity);
  ASSERT_FALSE(second);
  EXPECT_NE(second.error().message.find("another campaign writes"), std::string::npos);
}

TEST_F(FlightTableTest, NamesFileAndLineOfWhatItCannotRead) {
  {
    FlightTable table = open(file_);
    add(table, 1);
  }
  append(file_, "a,b\n");
  const auto refused = FlightTable::open(file_, some_flight(1).identity);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message.find(file_ + ":3: 2 cells, not "), 0U) << refused.error().message;
}

TEST(JoinFlights, TakesASeedTwiceOnlyWhenItIsTheSameFlight) {
  Flights all, more;
  all.records[1] = some_flight(1);
  more.records[1] = some_flight(1);
  more.records[2] = some_flight(2);
  ASSERT_TRUE(join(all, more));
  EXPECT_EQ(all.records.size(), 2U);
  more.records[2].requests += 1;
  EXPECT_FALSE(join(all, more));
  Flights other;
  other.records[9] = some_flight(9);
  other.records[9].identity.version = "0.2";
  EXPECT_FALSE(join(all, other));
}

}  // namespace
}  // namespace tern
