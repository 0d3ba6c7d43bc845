// A host reports its node's health and configuration, and paces.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <lcm/lcm-cpp.hpp>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "core/base/digest.h"
#include "core/base/random.h"
#include "core/wire/message_limits.h"
#include "messages/codec.h"
#include "runtime/clock_exchange.h"
#include "runtime/lcm_network.h"
#include "runtime/platform.h"
#include "runtime/version.h"
#include "runtime/virtual_runner.h"
#include "talker.h"

namespace tern {
namespace {

constexpr UTime kStart{1'000'000};

TEST(NodeHost, BeatsTwiceASecondAndReportsItsConfigurationAtTheStartAndEveryFiveSeconds) {
  VirtualRunner runner(kStart);
  std::vector<Heartbeat> beats;
  std::vector<ConfigurationReport> reports;
  runner.observer().subscribe(channels::kHeartbeat, [&](const Heartbeat& h) { beats.push_back(h); });
  runner.observer().subscribe(channels::kConfiguration, [&](const ConfigurationReport& r) { reports.push_back(r); });
  runner.start(
      "tern-test",
      [](Bus& bus) {
        return std::make_unique<Talker>(bus, Talker::Options{"t", Duration{100'000}}, nullptr);
      },
      "x: 1\n");
  runner.run(kStart + Duration{10'000'000});
  EXPECT_EQ(beats.size(), 21U);
  EXPECT_EQ(beats.back().process, "tern-test");
  EXPECT_EQ(beats.back().build_id, build_id());
  EXPECT_EQ(beats.back().state, ProcessState::Ready);
  EXPECT_EQ(beats.back().channels.at(channels::kGoal.name).sent, 101);
  ASSERT_EQ(reports.size(), 3U);
  EXPECT_EQ(reports[0].header.utime, kStart);
  EXPECT_EQ(reports[0].yaml, "x: 1\n");
  EXPECT_EQ(reports[0].build_id, build_id());
  EXPECT_EQ(reports[0].platform, platform());
  EXPECT_EQ(reports[0].hash, configuration_hash("x: 1\n"));
}

/// A node that waits until kStart + 7 s, and again from 20 s on.
class LongWaiter final : public Node {
 public:
  explicit LongWaiter(Bus& bus) : bus_(bus) {}
  [[nodiscard]] UTime next_wakeup() const override { return kNever; }
  void step(UTime /*now*/) override {}
  [[nodiscard]] NodeHealth health() const override {
    const double s = (bus_.clock().now() - kStart).seconds();
    return s < 7.0 || s >= 20.0 ? NodeHealth{ProcessState::Waiting, "a map"} : NodeHealth{ProcessState::Ready, ""};
  }

 private:
  Bus& bus_;
};

TEST(NodeHost, LogsOnceForWhatItHasBeenWaitingLong) {
  VirtualRunner runner(kStart);
  runner.start("tern-test", [](Bus& bus) { return std::make_unique<LongWaiter>(bus); });
  const auto said = [&](double until_s) {
    ::testing::internal::CaptureStdout();
    runner.run(kStart + Duration::from_seconds(until_s));
    return ::testing::internal::GetCapturedStdout();
  };
  EXPECT_EQ(said(4.9).find("waiting"), std::string::npos);
  EXPECT_NE(said(5.6).find("has been waiting for 5 s: a map"), std::string::npos);
  EXPECT_EQ(said(24.9).find("waiting"), std::string::npos);
  EXPECT_NE(said(25.6).find("has been waiting for 5 s: a map"), std::string::npos);
}

/// A node with notes of its own.
class Noter final : public Node {
 public:
  explicit Noter(std::vector<std::string> notes) : notes_(std::move(notes)) {}
  [[nodiscard]] UTime next_wakeup() const override { return kNever; }
  void step(UTime /*now*/) override {}
  [[nodiscard]] NodeHealth health() const override { return {ProcessState::Ready, ""}; }
  [[nodiscard]] std::vector<std::string> notes() const override { return notes_; }

 private:
  std::vector<std::string> notes_;
};

std::string reported(const std::string& yaml, const std::vector<std::string>& notes) {
  VirtualRunner runner(kStart);
  std::optional<ConfigurationReport> report;
  runner.observer().subscribe(channels::kConfiguration, [&](const ConfigurationReport& r) { report = r; });
  runner.start(
      "tern-test", [&](Bus&) { return std::make_unique<Noter>(notes); }, yaml);
  runner.run(kStart + Duration{100'000});
  return report ? report->yaml : "no report";
}

TEST(NodeHost, ReportsANodesNotesAsComments) {
  EXPECT_EQ(reported("x: 1\n", {"obstacle 1: a", "two\nlines"}), "x: 1\n# obstacle 1: a\n# two lines\n");
  EXPECT_EQ(reported("", {}), "");
}

TEST(NodeHost, SaysHowManyNotesDidNotFit) {
  const std::vector<std::string> notes(10'000, "obstacle 1: a");
  const std::string yaml = reported("x: 1\n", notes);
  EXPECT_LE(yaml.size(), kMaxYamlText);
  EXPECT_GT(yaml.size(), kMaxYamlText - 200);
  EXPECT_TRUE(yaml.ends_with(" of 10000 notes\n")) << yaml.substr(yaml.size() - 80);
  EXPECT_LE(reported(std::string(kMaxYamlText, '#'), notes).size(), kMaxYamlText);
}

/// A node that only waits.
class Waiter final : public Node {
 public:
  explicit Waiter(std::string words) : words_(std::move(words)) {}
  [[nodiscard]] UTime next_wakeup() const override { return kNever; }
  void step(UTime /*now*/) override {}
  [[nodiscard]] NodeHealth health() const override { return {ProcessState::Waiting, words_}; }

 private:
  std::string words_;
};

/// Returns what the receivers of a node's heartbeats read of its words; nullopt if they accept no heartbeat.
std::optional<std::string> heard_of(const std::string& words) {
  VirtualRunner runner(kStart);
  std::optional<std::string> heard;
  runner.observer().subscribe(channels::kHeartbeat, [&](const Heartbeat& h) { heard = h.waiting_for; });
  runner.start("tern-test", [&](Bus&) { return std::make_unique<Waiter>(words); });
  runner.run(kStart + Duration{100'000});
  return heard;
}

TEST(NodeHost, SendsAHeartbeatThatReceiversAcceptWhateverItsNodeSays) {
  EXPECT_EQ(heard_of("σ of 2 m"), "σ of 2 m");
  EXPECT_EQ(heard_of("a file with \xff\x01"), "a file with ??");
  const auto limit = static_cast<std::size_t>(kMaxWaitingText);
  EXPECT_EQ(heard_of(std::string(limit, 'x')), std::string(limit, 'x'));
  EXPECT_EQ(heard_of(std::string(limit + 1, 'x')), std::string(limit, 'x')) << "it would not be sent at all";
}

TEST(NodeHost, TellsBackWhatItHeardAndAnswersANewProcessAtOnce) {
  VirtualRunner runner(kStart);
  std::vector<Heartbeat> beats;
  runner.observer().subscribe(channels::kHeartbeat, [&](const Heartbeat& h) { beats.push_back(h); });
  const auto start = [&](const char* name) {
    runner.start(name, [](Bus& bus) {
      return std::make_unique<Talker>(bus, Talker::Options{"t", Duration{100'000}}, nullptr);
    });
  };
  start("first");
  runner.run(kStart + Duration{700'000});
  beats.clear();
  start("second");
  runner.run(kStart + Duration{700'000} + kHeartbeatSpacing);
  // The second one publishes a heartbeat at its start, and echoes the first one's as soon as it arrives.
  ASSERT_EQ(beats.size(), 3U);
  EXPECT_EQ(beats[1].process, "first");
  EXPECT_EQ(beats[2].process, "second");
  for (const auto& [heard, told] : {std::pair(0, 1), std::pair(1, 2)}) {
    const Heartbeat& h = beats[static_cast<std::size_t>(heard)];
    const Heartbeat& t = beats[static_cast<std::size_t>(told)];
    ASSERT_EQ(t.echoes.size(), 1U);
    EXPECT_EQ(t.echoes[0].sender_epoch_us, h.header.name.sender_epoch_us);
    EXPECT_EQ(t.echoes[0].sent, h.header.utime);
  }
}

TEST(ClockEchoes, KeepsTheNewestOfEachForAWhileAndNoMoreThanAMessageHolds) {
  ClockEchoes heard;
  EXPECT_TRUE(heard.receive({{5, 1}, UTime{10}}, UTime{100}));
  EXPECT_FALSE(heard.receive({{5, 2}, UTime{20}}, UTime{200}));
  ASSERT_EQ(heard.echoes(UTime{300}).size(), 1U);
  EXPECT_EQ(heard.echoes(UTime{300})[0].sent, UTime{20});
  const UTime later = UTime{201} + ClockEchoes::kOldest;
  EXPECT_TRUE(heard.echoes(later).empty());
  EXPECT_TRUE(heard.receive({{5, 3}, UTime{30}}, later));
  for (int k = 0; k < 1'000; ++k) heard.receive({{100 + k, 1}, UTime{40}}, later + Duration{k});
  const std::vector<ClockEcho> echoes = heard.echoes(later + Duration{1'000});
  ASSERT_EQ(echoes.size(), static_cast<std::size_t>(kMaxClockEchoes));
  EXPECT_EQ(echoes.front().sender_epoch_us, 1'100 - kMaxClockEchoes);
}

/// Random clocks, delays and drifts: the reading is never off by more than half its round trip.
RC_GTEST_PROP(ClockSkew, IsOffByHalfTheRoundTripAtMost, (std::uint64_t seed)) {
  Rng rng(seed);
  const std::int64_t ahead = static_cast<std::int64_t>(rng.uniform(-1e6, 1e6));
  ClockSkew skew;
  for (int k = 0; k < 10; ++k) {
    const auto some = [&](double most) { return Duration{static_cast<std::int64_t>(rng.uniform(0.0, most))}; };
    const UTime sent{k * 500'000};
    const UTime there = sent + some(1e5);
    const UTime back = there + some(5e5);
    skew.add({1, sent, there + Duration{ahead}}, back + Duration{ahead}, back + some(1e5));
  }
  const ClockReading reading = skew.reading().value();
  RC_ASSERT(std::abs(reading.ahead.us - ahead) * 2 <= reading.round_trip.us + 1);
}

TEST(NodeHost, CutsAConfigurationThatNoMessageHoldsAndStillTellsTwoApart) {
  std::string yaml;
  while (yaml.size() < 100'000) yaml += "key: value\n";
  const std::string cut = reported_yaml(yaml);
  EXPECT_LE(cut.size(), static_cast<std::size_t>(kMaxYamlText));
  EXPECT_NE(cut.find("# cut here: "), std::string::npos);
  std::string other = yaml;
  other.back() = ' ';
  EXPECT_NE(configuration_hash(other), configuration_hash(yaml));
  ConfigurationReport report;
  report.header = {{1, 1}, kStart};
  report.process = "x";
  report.yaml = cut;
  report.hash = configuration_hash(yaml);
  EXPECT_TRUE(decode<ConfigurationReport>(encode(report)));
  EXPECT_EQ(reported_yaml("short: 1\n"), "short: 1\n");
  EXPECT_LE(reported_yaml(std::string(100'000, 'x')).size(), static_cast<std::size_t>(kMaxYamlText));
}

/// Sends a set of goals once, paced.
class Pacer final : public Node {
 public:
  explicit Pacer(Bus& bus) : bus_(bus) {}
  [[nodiscard]] UTime next_wakeup() const override { return done_ ? kNever : kStart; }
  void step(UTime /*now*/) override {
    if (std::exchange(done_, true)) return;
    std::vector<Goal> goals(4);
    for (Goal& goal : goals) goal.id = 1;
    bus_.publish_paced(channels::kGoal, goals);
  }
  [[nodiscard]] NodeHealth health() const override { return {ProcessState::Ready, ""}; }

 private:
  Bus& bus_;
  bool done_ = false;
};

TEST(NodeHost, WakesForPacedMessages) {
  VirtualRunner runner(kStart);
  runner.start("pacer", [](Bus& bus) { return std::make_unique<Pacer>(bus); });
  std::vector<std::int64_t> times;
  runner.observer().subscribe(channels::kGoal, [&](const Goal& g) { times.push_back((g.header.utime - kStart).us); });
  runner.run(kStart + Duration{100'000});
  EXPECT_EQ(times, (std::vector<std::int64_t>{0, 2'000, 4'000, 6'000}));
}

TEST(LcmUrl, IsTheOptionElseTheEnvironmentElseThisHostOnly) {
  EXPECT_EQ(choose_lcm_url("memq://", "udpm://x"), "memq://");
  EXPECT_EQ(choose_lcm_url("", "file:///tmp/x"), "file:///tmp/x");
  EXPECT_EQ(choose_lcm_url("", nullptr), std::string(kDefaultLcmUrl) + "&recv_buf_size=8000000");
  EXPECT_EQ(choose_lcm_url("", ""), std::string(kDefaultLcmUrl) + "&recv_buf_size=8000000");
  EXPECT_EQ(choose_lcm_url("udpm://239.255.76.67:7777", nullptr), "udpm://239.255.76.67:7777?recv_buf_size=8000000");
  EXPECT_EQ(choose_lcm_url("udpm://a:1?recv_buf_size=5&ttl=0", nullptr), "udpm://a:1?recv_buf_size=5&ttl=0");
}

TEST(WallClock, IsTheSystemClockPlusItsOffset) {
  const UTime plain = WallClock().now();
  const UTime ahead = WallClock(Duration{3'600'000'000}).now();
  EXPECT_GE((ahead - plain).us, 3'600'000'000);
  EXPECT_GT(plain.us, 1'600'000'000'000'000) << "microseconds since 1970";
}

RC_GTEST_PROP(UniqueEpoch, TellsProcessesOfOneMomentApartAndAscendsWithTime, ()) {
  const auto now = *rc::gen::inRange<std::int64_t>(1'600'000'000'000'000, 2'000'000'000'000'000);
  const auto later = now + *rc::gen::inRange<std::int64_t>(2'048, 1'000'000);
  const auto one = *rc::gen::inRange<std::int64_t>(1, 4'194'304);
  const auto other = *rc::gen::inRange<std::int64_t>(1, 4'194'304);
  const std::int64_t epoch = unique_epoch(now, one);
  RC_ASSERT(epoch <= now && epoch >= now - 2'048);
  RC_ASSERT((epoch == unique_epoch(now, other)) == (one % 1024 == other % 1024));
  RC_ASSERT(unique_epoch(later, other) > epoch);
}

TEST(VirtualClock, NeverGoesBack) {
  VirtualClock clock(kStart);
  clock.advance_to(kStart);
  EXPECT_THROW(clock.advance_to(kStart - Duration{1}), std::invalid_argument);
}

}  // namespace
}  // namespace tern
