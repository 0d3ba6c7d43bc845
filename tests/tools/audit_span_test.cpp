// A part of a flight is never called held for the whole, and a verdict that cannot be written is none.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "flight_log/log_reader.h"
#include "messages/codec.h"
#include "tests/tools/audit_of_a_log.h"

namespace tern::audit {
namespace {

using ::testing::Contains;
using testing::copy_log;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::MatchesRegex;

/// Appends an event as it stands in a log, with its number.
void put_event(std::string& bytes, const LogEvent& event) {
  const auto put = [&bytes](std::uint64_t value, int count) {
    for (int k = count - 1; k >= 0; --k) bytes.push_back(static_cast<char>(value >> static_cast<unsigned>(8 * k)));
  };
  put(kLogSyncWord, 4);
  put(static_cast<std::uint64_t>(event.number), 8);
  put(static_cast<std::uint64_t>(event.received_us), 8);
  put(event.channel.size(), 4);
  put(event.data.size(), 4);
  bytes += event.channel;
  bytes.append(event.data.begin(), event.data.end());
}

TEST_F(AuditOfALog, OfAPartIsIncompleteAndSaysFromWhenToWhenTheLogReaches) {
  const std::string begun = another_file(), late = another_file(), away = another_file();
  testing::copy_part_of_log(good(), begun, 0, at_us(1.2));
  testing::copy_part_of_log(good(), late, at_us(2.0), INT64_MAX);
  testing::copy_log_without(good(), away, at_us(2.0), at_us(3.2));
  const std::vector<std::pair<std::string, std::string>> parts{
      {begun, "the flight's end: the log ends at 1."},
      {late, "the flight's beginning: the first request in the log is number"},
      {away, "all messages from "}};
  for (const auto& [log, gap] : parts) {
    const Audit part = audit(log);
    EXPECT_EQ(part.verdict(), Verdict::Incomplete) << text(part);
    EXPECT_THAT(text(part), HasSubstr("Not in the log:\n  " + gap));
    EXPECT_THAT(text(part), HasSubstr("INCOMPLETE: nothing is broken in the part of the flight that the log holds; it "
                                      "reaches from "));
    EXPECT_EQ(to_json(part, read_)["verdict"], "incomplete");
    EXPECT_THAT(to_json(part, read_)["reaches"]["gaps"][0].get<std::string>(), HasSubstr(gap));
    EXPECT_EQ(run_program(log), 3);
  }
  EXPECT_THAT(text(audit(late)), HasSubstr(" of a flight of ")) << "FLIGHT_RESULT says how long it was";
}

TEST_F(AuditOfALog, OfATruncatedFileIsIncompleteAndTheSummaryBesideItSaysOfHowMuch) {
  const TempFolder flight;
  std::ifstream whole(good(), std::ios::binary);
  std::string bytes(std::istreambuf_iterator<char>(whole), {});
  std::ofstream(flight.file("flight.lcm"), std::ios::binary) << bytes.substr(0, bytes.size() / 2);
  std::ofstream(flight.file("summary.json")) << R"({"log": "/r/flight.lcm", "flight_time_s": 13.25})";
  const Audit part = audit(flight.file("flight.lcm"));
  EXPECT_EQ(part.verdict(), Verdict::Incomplete);
  EXPECT_THAT(text(part), HasSubstr(" s of a flight of 13.25 s"));
}

TEST_F(AuditOfALog, WithMessagesThatTheLoggerCouldNotWriteIsIncomplete) {
  const std::string log = another_file();
  auto reader = LogReader::open(good()).value();
  std::string bytes;
  for (int k = 0; auto event = reader.next(); ++k) {
    if (k == 500) reader.next();  // its number is missing then, as after a write that failed
    put_event(bytes, *event);
  }
  std::ofstream(log, std::ios::binary) << bytes;
  const Audit part = audit(log);
  EXPECT_EQ(part.verdict(), Verdict::Incomplete) << text(part);
  EXPECT_THAT(text(part), HasSubstr("1 messages which tern-logger could not write"));

  const std::string said = with<Heartbeat>(good(), channels::kHeartbeat.name, [](Heartbeat& heartbeat) {
    if (heartbeat.process != "tern-planner") return true;
    heartbeat.process = "tern-logger";
    heartbeat.state = ProcessState::Failed;
    heartbeat.waiting_for = "132 messages are not in the log";
    return true;
  });
  EXPECT_EQ(audit(said).verdict(), Verdict::Incomplete);
}

TEST_F(AuditOfALog, WithoutAStateOfTheVehicleComparesNothingAndIsIncomplete) {
  const auto is_state = [](std::string_view channel) {
    return channel == channels::kUavState.name || channel == channels::kVehicleTruth.name;
  };
  const std::string absent = another_file(), refused = another_file();
  copy_log(good(), absent, [&](std::string_view channel, std::vector<std::uint8_t>& bytes) {
    if (is_state(channel)) bytes.clear();
  });
  copy_log(good(), refused, [&](std::string_view channel, std::vector<std::uint8_t>& bytes) {
    if (is_state(channel)) bytes[0] ^= 1U;
  });
  for (const std::string& log : {absent, refused}) {
    const Audit audited = audit(log);
    EXPECT_THAT(broken(audited), IsEmpty());
    EXPECT_EQ(audited.check("clearance").verdict(), Verdict::NotChecked) << text(audited);
    EXPECT_THAT(audited.span.gaps, Contains("the vehicle's states"));
    EXPECT_EQ(audited.verdict(), Verdict::Incomplete);
    EXPECT_EQ(run_program(log), 3);
  }
}

TEST_F(AuditOfALog, WithoutStatesAtTheStartOrTheEndOfTheFlightIsIncomplete) {
  const double end = record_->results.front().flight_time_s;
  for (const auto& [from, to, gap] : {std::tuple{-100.0, 0.9, "the vehicle's states before 0.9"},
                                      std::tuple{end - 0.9, end + 100.0, "the vehicle's states from "}}) {
    const std::string log = another_file();
    copy_log(good(), log, [&, from = from, to = to](std::string_view channel, std::vector<std::uint8_t>& bytes) {
      if (channel != channels::kUavState.name && channel != channels::kVehicleTruth.name) return;
      const UTime at = decode<UavState>(bytes).value().at;
      if (at.us > at_us(from) && at.us < at_us(to)) bytes.clear();
    });
    const Audit audited = audit(log);
    EXPECT_EQ(audited.verdict(), Verdict::Incomplete) << text(audited);
    EXPECT_THAT(audited.span.gaps, ElementsAre(HasSubstr(gap)));
  }
}

TEST_F(AuditOfALog, OfAChannelWhoseMessagesWereAllRefusedIsIncomplete) {
  const std::string log = another_file();
  copy_log(good(), log, [](std::string_view channel, std::vector<std::uint8_t>& bytes) {
    if (channel == channels::kPredictions.name) bytes[0] ^= 1U;
  });
  const Audit audited = audit(log);
  EXPECT_THAT(audited.span.gaps, ElementsAre(MatchesRegex("all [0-9]+ messages of PREDICTIONS: damaged.*")));
  EXPECT_EQ(audited.verdict(), Verdict::Incomplete);
}

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST_F(AuditOfALog, ThatIsDamagedWithinTheFlightIsIncomplete) {
  const std::string zeroed = another_file(), inserted = another_file(), after = another_file();
  const std::string bytes = bytes_of(good());
  const std::size_t sync = bytes.find("\xED\xA1\xDA\x01", bytes.size() / 2);
  std::ofstream(zeroed, std::ios::binary) << std::string(bytes).replace(bytes.size() / 2, 100'000, 100'000, '\0');
  std::ofstream(inserted, std::ios::binary) << std::string(bytes).insert(sync, "words of somebody else");
  std::ofstream(after, std::ios::binary) << bytes << "words of somebody else";
  const Audit lost = audit(zeroed);
  EXPECT_EQ(lost.verdict(), Verdict::Incomplete) << text(lost);
  EXPECT_THAT(lost.span.gaps, Contains(HasSubstr("as the event numbers show; the log is damaged in 1 places")));
  EXPECT_THAT(audit(inserted).span.gaps, ElementsAre("what stood in 22 damaged bytes of the log"));
  EXPECT_EQ(audit(after).verdict(), Verdict::Held) << "the flight had ended before";
}

TEST_F(AuditOfALog, WithoutOneOfItsPartsIsIncomplete) {
  const TempFolder flight;
  const std::string bytes = bytes_of(good());
  const std::size_t third = bytes.find("\xED\xA1\xDA\x01", bytes.size() / 3);
  std::ofstream(flight.file("flight.lcm"), std::ios::binary) << bytes.substr(0, third);
  std::ofstream(flight.file("flight.002.lcm"), std::ios::binary) << bytes.substr(third);
  const Audit part = audit(flight.file("flight.lcm"));
  EXPECT_EQ(part.verdict(), Verdict::Incomplete) << text(part);
  EXPECT_THAT(part.span.gaps, ElementsAre("the log's part flight.001.lcm"));
}

TEST_F(AuditOfALog, InAFolderWhoseNameIsNotUtf8WritesItsJson) {
  const TempFolder flight;
  const std::string folder = flight.file("flight_\xff");
  std::filesystem::create_directory(folder);
  std::filesystem::copy_file(good(), folder + "/flight.lcm");
  EXPECT_EQ(run_program("'" + folder + "' --json '" + flight.file("audit.json") + "'"), 0);
  std::ifstream json(flight.file("audit.json"));
  EXPECT_EQ(nlohmann::json::parse(json)["verdict"], "held");
}

TEST_F(AuditOfALog, WhoseTextCannotBeWrittenIsAnError) {
  const std::string command = std::string(TERN_AUDIT_PROGRAM) + " " + good() + " 2>&1 >/dev/full | cat >" +
                              folder_->file("said") + "; exit ${PIPESTATUS[0]}";
  EXPECT_EQ(WEXITSTATUS(std::system(("bash -c '" + command + "'").c_str())), 2);
  EXPECT_THAT(bytes_of(folder_->file("said")), HasSubstr("the output cannot be written: No space left on device"));
  EXPECT_EQ(WEXITSTATUS(std::system((std::string(TERN_AUDIT_PROGRAM) + " --help >/dev/full 2>&1").c_str())), 2);
}

TEST_F(AuditOfALog, OfAFlightThatNeverBeganIsNotJudged) {
  const std::string log = another_file();
  testing::copy_part_of_log(good(), log, 0, record_->requests.front().header.utime.us);
  const Audit nothing = audit(log);
  EXPECT_EQ(nothing.verdict(), Verdict::NotJudged) << text(nothing);
  EXPECT_THAT(text(nothing), HasSubstr("NOT JUDGED: the flight never began"));
  EXPECT_EQ(run_program(log), 4);
}

}  // namespace
}  // namespace tern::audit
