#include "flight_log/flight_log.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "flight_log/log_writer.h"
#include "messages/codec.h"
#include "tests/support/temp_folder.h"

namespace tern {
namespace {

Goal goal(std::int64_t sequence) {
  Goal g;
  g.header = {{7, sequence}, UTime{1'000}};
  g.id = sequence;
  return g;
}

class FlightLogTest : public ::testing::Test {
 protected:
  void write(const std::string& channel, const Bytes& bytes) { writer_->append(channel, 1'000 + time_++, bytes); }
  void next_part() { writer_.emplace(*LogWriter::open(path_, 0)); }
  LogContents read(FlightLog& log) {
    (void)writer_->flush();
    return *log.read(path_);
  }

  TempFolder folder_;
  std::string path_ = folder_.file("flight.lcm");
  std::optional<LogWriter> writer_{*LogWriter::open(path_, 0)};
  std::int64_t time_ = 0;
};

TEST_F(FlightLogTest, HandsOverMessagesInTheLogsOrderThroughAllParts) {
  write(channels::kGoal.name, encode(goal(1)));
  next_part();
  write(channels::kGoal.name, encode(goal(2)));
  write(channels::kGoal.name, encode(goal(3)));
  FlightLog log;
  std::vector<std::int64_t> ids, times;
  log.on(channels::kGoal, [&](const Goal& g, std::int64_t received_us) {
    ids.push_back(g.id);
    times.push_back(received_us);
  });
  const LogContents contents = read(log);
  EXPECT_EQ(ids, (std::vector<std::int64_t>{1, 2, 3}));
  EXPECT_EQ(times, (std::vector<std::int64_t>{1'000, 1'001, 1'002}));
  EXPECT_EQ(contents.parts, (std::vector<std::string>{path_, folder_.file("flight.001.lcm")}));
  EXPECT_EQ(contents.first_us, 1'000);
  EXPECT_EQ(contents.last_us, 1'002);
}

TEST_F(FlightLogTest, AFolderMeansTheFlightInIt) {
  EXPECT_EQ(log_parts(std::filesystem::path(path_).parent_path().string()), std::vector<std::string>{path_});
}

/// A log of ten parts with one event each, as one logger writes it.
void write_ten_parts(const std::string& path) {
  std::filesystem::remove(path);
  auto writer = LogWriter::open(path, 1);
  for (int k = 1; k <= 10; ++k) {
    writer->append(channels::kGoal.name, 1'000 + k, encode(goal(k)));
    (void)writer->flush();
  }
}

TEST_F(FlightLogTest, APartThatIsMissingEndsNoLogAndIsNamed) {
  write_ten_parts(path_);
  FlightLog log;
  EXPECT_TRUE(log.read(path_)->missing_parts.empty());
  for (const char* lost : {"flight.001.lcm", "flight.004.lcm", "flight.005.lcm", "flight.006.lcm"}) {
    std::filesystem::remove(folder_.file(lost));
  }
  const LogContents contents = *log.read(path_);
  EXPECT_EQ(contents.events, 6);
  EXPECT_EQ(contents.parts[1], folder_.file("flight.002.lcm"));
  EXPECT_EQ(contents.missing_parts, (std::vector<std::string>{"flight.001.lcm", "flight.004.lcm to flight.006.lcm"}));
  EXPECT_EQ(contents.damage.missing, 4) << "as the event numbers show";
}

TEST_F(FlightLogTest, AFileWithAnotherKindOfNameIsNoPart) {
  for (const char* name : {"flight.2.lcm", "flight.0002.lcm", "flight.000.lcm", "flight.-01.lcm", "flight.002.lcm.bak",
                           "flight2.002.lcm", "flight.002.txt", "flight..lcm"}) {
    std::ofstream(folder_.file(name)) << "?";
  }
  EXPECT_EQ(log_parts(path_), std::vector<std::string>{path_});
  EXPECT_TRUE(missing_log_parts(path_).empty());
}

TEST_F(FlightLogTest, CountsTheEventsThatAreMissingBetweenTwoParts) {
  std::filesystem::remove(path_);
  auto writer = LogWriter::open(path_, 1);
  for (int part = 0; part < 2; ++part) {
    for (int k = 1; k <= 20; ++k) writer->append(channels::kGoal.name, 1'000, encode(goal(20 * part + k)));
    (void)writer->flush();
  }
  const std::string second = folder_.file("flight.001.lcm");
  std::ifstream file(second, std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(file), {});
  std::ofstream(second, std::ios::binary) << bytes.substr(bytes.size() / 20 * 12);
  FlightLog log;
  const LogContents contents = *log.read(path_);
  EXPECT_EQ(contents.events, 28);
  EXPECT_EQ(contents.damage.missing, 12);
  EXPECT_EQ(contents.damage.places, 0);
}

TEST_F(FlightLogTest, ALoggerThatWasRestartedLeavesNoGap) {
  for (int k = 1; k <= 3; ++k) write(channels::kGoal.name, encode(goal(k)));
  next_part();
  for (int k = 4; k <= 6; ++k) write(channels::kGoal.name, encode(goal(k)));
  FlightLog log;
  EXPECT_EQ(read(log).damage.missing, 0);
}

TEST_F(FlightLogTest, SaysBetweenWhichMessagesDamagedPlacesLie) {
  for (int k = 1; k <= 4; ++k) write(channels::kGoal.name, encode(goal(k)));
  (void)writer_->flush();
  std::ifstream file(path_, std::ios::binary);
  std::string bytes(std::istreambuf_iterator<char>(file), {});
  bytes.replace(bytes.size() / 4, 4, 4, '\0');
  std::ofstream(path_, std::ios::binary) << "?" << bytes << "?";
  FlightLog log;
  using Places = std::vector<std::pair<std::int64_t, std::int64_t>>;
  EXPECT_EQ(log.read(path_)->damaged, (Places{{INT64_MIN, 1'000}, {1'000, 1'002}, {1'003, INT64_MAX}}));
}

TEST_F(FlightLogTest, CountsWhatIsLostForeignOrOfAnotherVersion) {
  for (const int k : {3, 6, 7, 8, 9}) write(channels::kGoal.name, encode(goal(k)));
  write(channels::kGoal.name, encode(UavState{}));
  write("CAMERA", Bytes(1'000));
  FlightLog log;
  int seen = 0;
  log.on(channels::kGoal, [&](const Goal&, std::int64_t) { ++seen; });
  const LogContents contents = read(log);
  EXPECT_EQ(seen, 5);
  const LogChannel& goals = contents.channels.at(channels::kGoal.name);
  EXPECT_EQ(goals.messages, 6);
  EXPECT_EQ(goals.lost, 2);
  EXPECT_EQ(goals.before_first, 2);
  EXPECT_EQ(goals.refused[static_cast<int>(Rejection::Fingerprint)], 1);
  EXPECT_TRUE(goals.read);
  EXPECT_FALSE(goals.foreign);
  EXPECT_TRUE(contents.channels.at("CAMERA").foreign);
}

TEST_F(FlightLogTest, AForgedNumberIsNoLoss) {
  for (const int k : {1, 2, 3, 1'000'000, 4, 5, 6}) write(channels::kGoal.name, encode(goal(k)));
  FlightLog log;
  log.on(channels::kGoal, [](const Goal&, std::int64_t) {});
  const LogChannel goals = read(log).channels.at(channels::kGoal.name);
  EXPECT_EQ(goals.lost, 0);
  EXPECT_EQ(goals.before_first, 0);
}

TEST_F(FlightLogTest, AnotherVehiclesChannelsAreForeign) {
  write("GOAL_a", encode(goal(1)));
  write("GOAL_b", encode(goal(1)));
  FlightLog log("_a");
  int seen = 0;
  log.on(channels::kGoal, [&](const Goal&, std::int64_t) { ++seen; });
  const LogContents contents = read(log);
  EXPECT_EQ(seen, 1);
  EXPECT_FALSE(contents.channels.at("GOAL_a").foreign);
  EXPECT_TRUE(contents.channels.at("GOAL_b").foreign);
}

TEST_F(FlightLogTest, HandsOverOnceWhatTheNetworkDeliveredTwice) {
  for (int k = 1; k <= 3; ++k) {
    for (int copy = 0; copy < 2; ++copy) write(channels::kGoal.name, encode(goal(k)));
  }
  write(channels::kGoal.name, encode(goal(2)));  // late
  FlightLog log;
  std::vector<std::int64_t> ids;
  log.on(channels::kGoal, [&](const Goal& g, std::int64_t) { ids.push_back(g.id); });
  const LogContents contents = read(log);
  EXPECT_EQ(ids, (std::vector<std::int64_t>{1, 2, 3}));
  EXPECT_EQ(contents.channels.at(channels::kGoal.name).messages, 7);
  EXPECT_EQ(contents.channels.at(channels::kGoal.name).repeated, 4);
  EXPECT_EQ(contents.channels.at(channels::kGoal.name).lost, 0);
}

TEST_F(FlightLogTest, SaysWhichPartCannotBeOpened) {
  FlightLog log;
  const auto contents = log.read(folder_.file("none.lcm"));
  ASSERT_FALSE(contents);
  EXPECT_NE(contents.error().message.find("none.lcm"), std::string::npos);
}

}  // namespace
}  // namespace tern
