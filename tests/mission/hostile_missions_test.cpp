// Damaged files: the readers of missions and fences return a value or an error for any bytes.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/base/random.h"
#include "messages/codec.h"
#include "mission/readers/mission_file.h"
#include "mission/upload/fence_items.h"
#include "mission/upload/mission_server.h"
#include "semantic_mapper/sources/fence_file.h"
#include "tests/mission/some_site.h"
#include "tests/support/effort.h"

namespace tern::mission {
namespace {

const int kMutations = support::at_effort(10'000);

/// Values that a text may be given: out of range, of another type, no numbers.
constexpr const char* kWords[] = {"null",
                                  "true",
                                  "-1",
                                  "1e999",
                                  "nan",
                                  "inf",
                                  "-0",
                                  "65536",
                                  "\"\"",
                                  "[]",
                                  "{}",
                                  "1e-320",
                                  "99999999999999999999",
                                  "\xff\xfe",
                                  ",",
                                  "\n",
                                  "\"",
                                  "-",
                                  "0x10"};

/// Damages a text: overwrites, removes, repeats, inserts a word, replaces a number, or cuts it off.
std::string mutated(std::string text, Rng& rng) {
  for (int n = 1 + static_cast<int>(rng.uniform(0, 4)); n > 0 && !text.empty(); --n) {
    const auto at = static_cast<std::size_t>(rng.uniform(0, static_cast<double>(text.size())));
    const auto length = static_cast<std::size_t>(rng.uniform(0, 12));
    const char* const word = kWords[static_cast<std::size_t>(rng.uniform(0, std::size(kWords)))];
    switch (static_cast<int>(rng.uniform(0, 7))) {
      case 0: text[at] = static_cast<char>(rng.uniform(-128, 128)); break;
      case 1: text.erase(at, length); break;
      case 2: text.insert(at, text.substr(at, length)); break;
      case 3: text.insert(at, word); break;
      case 4:
      case 5: {
        const std::size_t first = text.find_first_of("0123456789", at);
        if (first == std::string::npos) break;
        const std::size_t last = std::min(text.find_first_not_of("0123456789.", first), text.size());
        text.replace(first, last - first, word);
        break;
      }
      default: text.resize(at); break;
    }
  }
  return text;
}

void expect_sane_steps(const std::vector<Step>& steps) {
  ASSERT_FALSE(steps.empty());
  ASSERT_NE(steps.back().action, Action::Pass);
  for (const Step& step : steps) {
    ASSERT_TRUE(step.position.allFinite());
    ASSERT_LE(step.position.cwiseAbs().maxCoeff(), 2.0 * kMaxDistance);
    ASSERT_GE(step.hold_s, 0.0);
    ASSERT_GE(step.radius, 0.0);
    for (const char c : step.name) ASSERT_TRUE(c >= ' ' && c <= '~');
  }
}

void expect_sane(std::string_view text, const std::string& file) {
  const auto mission = parse_mission(text, file, testing::some_site());
  if (!mission) {
    ASSERT_TRUE(mission.error().message.starts_with(file + ": ")) << mission.error().message;
    ASSERT_LT(mission.error().message.size(), 400u);
    return;
  }
  expect_sane_steps(mission->steps);
}

void expect_sane_fences(std::string_view text, const std::string& file) {
  const auto fences = parse_fences(text, file);
  if (!fences) {
    ASSERT_TRUE(fences.error().message.starts_with(file + ": ")) << fences.error().message;
    return;
  }
  for (const Fence& fence : *fences) {
    ASSERT_LT(fence.floor, fence.ceiling);
    const auto in_world = to_world(fence, *testing::some_site().frame);
    ASSERT_TRUE(in_world.has_value());
  }
}

TEST(HostileMissions, MutatedPlansGiveAValueOrAnError) {
  Rng rng(1);
  for (int i = 0; i < kMutations && !HasFatalFailure(); ++i) {
    const std::string text = mutated(testing::kPlan, rng);
    expect_sane(text, "a.plan");
    expect_sane_fences(text, "a.plan");
  }
}

TEST(HostileMissions, MutatedCsvGivesAValueOrAnError) {
  Rng rng(2);
  for (int i = 0; i < kMutations && !HasFatalFailure(); ++i) expect_sane(mutated(testing::kCsv, rng), "a.csv");
}

TEST(HostileMissions, MutatedGeoJsonGivesAValueOrAnError) {
  Rng rng(3);
  for (int i = 0; i < kMutations && !HasFatalFailure(); ++i) {
    const std::string text = mutated(testing::kGeoJson, rng);
    expect_sane(text, "a.geojson");
    expect_sane_fences(text, "a.geojson");
  }
}

/// Items of a legal mission: take-off, waypoints, a hold, a landing.
mavlink::MissionItemInt legal_item(std::uint16_t seq, std::uint16_t count) {
  constexpr float kNotGiven = std::numeric_limits<float>::quiet_NaN();
  mavlink::MissionItemInt item;
  item.seq = seq;
  item.command = seq == 0 ? 22 : seq + 1 == count ? 21 : seq % 3 == 2 ? 19 : 16;
  item.frame = 6;
  item.autocontinue = 1;
  item.param = {1.0F, 0.0F, 0.0F, kNotGiven};
  item.x = 473'980'000 + 100 * seq;
  item.y = 85'456'000;
  item.z = 10.0F;
  item.target_system = 7;
  item.target_component = 1;
  return item;
}

TEST(HostileMissions, MutatedUploadsGiveAMissionOrAReason) {
  Rng rng(4);
  const Site site = testing::some_site();
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(rng.uniform(0, static_cast<double>(n))); };
  int taken = 0, refused = 0;
  const auto take = [&](const std::vector<Item>& items) -> std::string {
    if (items.empty()) return "";
    const auto steps = steps_of(items, site);
    steps ? ++taken : ++refused;
    if (steps) expect_sane_steps(*steps);
    return steps ? "" : steps.error().message;
  };
  for (int k = 0; k < kMutations && !HasFatalFailure(); ++k) {
    MissionServer server({7, 1}, {take, [](Order) { return std::string(); }});
    const auto count = static_cast<std::uint16_t>(1 + below(6));
    server.receive(mavlink::to_frame(mavlink::MissionCount{count, 7, 1, 0, 0}, {255, 190}, 0), UTime{1});
    const std::size_t spoiled = below(count);
    for (std::uint16_t seq = 0; seq < count; ++seq) {
      mavlink::Frame frame = mavlink::to_frame(legal_item(seq, count), {255, 190}, 0);
      for (std::size_t n = seq == spoiled ? 1 + below(3) : 0; n > 0; --n) {
        frame.payload[below(frame.payload.size())] = static_cast<std::uint8_t>(below(256));
      }
      ASSERT_LE(server.receive(frame, UTime{2}).size(), 12u);
    }
  }
  EXPECT_GT(taken, kMutations / 20);
  EXPECT_GT(refused, kMutations / 20);
}

/// Items of legal fences: a circle, a triangle, a return point, a circle.
mavlink::MissionItemInt legal_fence(std::uint16_t seq) {
  constexpr std::uint16_t kCommands[] = {5003, 5002, 5002, 5002, 5000, 5004};
  mavlink::MissionItemInt item;
  item.seq = seq;
  item.command = kCommands[seq];
  item.frame = 0;
  item.param = {item.command == 5002 ? 3.0F : 20.0F, 0.0F, 0.0F, 0.0F};
  item.x = 473'980'000 + 1000 * (seq % 2);
  item.y = 85'456'000 + 1000 * seq;
  item.target_system = 7;
  item.target_component = 1;
  item.mission_type = kFenceType;
  return item;
}

TEST(HostileMissions, MutatedFencesGiveFencesThatAMessageHoldsOrAReason) {
  Rng rng(5);
  const Site site = testing::some_site();
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(rng.uniform(0, static_cast<double>(n))); };
  int taken = 0, refused = 0;
  const auto take = [&](const std::vector<mavlink::MissionItemInt>& wire) -> std::string {
    std::vector<Item> items;
    for (const auto& item : wire) items.push_back(item_of(item));
    const auto fences = fences_of(items, site);
    fences ? ++taken : ++refused;
    if (!fences) {
      EXPECT_LT(fences.error().message.size(), 400u);
      return fences.error().message;
    }
    EXPECT_TRUE(decode<FenceSet>(encode(FenceSet{{{1, 1}, UTime{1}}, *fences})).has_value());
    return "";
  };
  for (int k = 0; k < kMutations && !HasFailure(); ++k) {
    MissionServer server(
        {7, 1}, {[](const auto&) { return std::string(); }, [](Order) { return std::string(); }, [] {}, take, ""});
    constexpr std::uint16_t kCount = 6;
    server.receive(mavlink::to_frame(mavlink::MissionCount{kCount, 7, 1, kFenceType, 0}, {255, 190}, 0), UTime{1});
    const std::size_t spoiled = below(kCount);
    for (std::uint16_t seq = 0; seq < kCount; ++seq) {
      mavlink::Frame frame = mavlink::to_frame(legal_fence(seq), {255, 190}, 0);
      for (std::size_t n = seq == spoiled ? 1 + below(3) : 0; n > 0; --n) {
        frame.payload[below(frame.payload.size())] = static_cast<std::uint8_t>(below(256));
      }
      ASSERT_LE(server.receive(frame, UTime{2}).size(), 12u);
    }
  }
  EXPECT_GT(taken, kMutations / 20);
  EXPECT_GT(refused, kMutations / 20);
}

}  // namespace
}  // namespace tern::mission
