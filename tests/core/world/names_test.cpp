#include "core/world/names.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace tern {
namespace {

std::string text_of(const std::string& file) {
  std::ifstream in(std::filesystem::path(TERN_SOURCE_FOLDER) / file);
  EXPECT_TRUE(in) << file;
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Expects `const int8_t SEARCH_ONLY = 1;` and so on.
template <class E>
void expect_constants_in(const std::string& file) {
  const std::string text = text_of(file);
  for (std::size_t k = 0; k < kWords<E>.size(); ++k) {
    std::string constant = key(static_cast<E>(k));
    for (char& c : constant) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    EXPECT_THAT(text, ::testing::HasSubstr("const int8_t " + constant + " = " + std::to_string(k) + ";")) << file;
  }
}

TEST(Names, AreTheConstantsOfTheMessagesDescriptions) {
  expect_constants_in<PlanOutcome>("lcmtypes/plan_t.lcm");
  expect_constants_in<PlanReason>("lcmtypes/plan_t.lcm");
  expect_constants_in<Phase>("lcmtypes/budget_cut_t.lcm");
  expect_constants_in<Stage>("lcmtypes/budget_cut_t.lcm");
  expect_constants_in<FlightOutcome>("lcmtypes/flight_result_t.lcm");
  expect_constants_in<GoalMode>("lcmtypes/goal_t.lcm");
  expect_constants_in<TrackKind>("lcmtypes/track_t.lcm");
  expect_constants_in<MotionKind>("lcmtypes/track_bound_t.lcm");
  expect_constants_in<BoundRule>("lcmtypes/track_bound_t.lcm");
  expect_constants_in<VoxelLabel>("lcmtypes/map_run_t.lcm");
  expect_constants_in<ProcessState>("lcmtypes/heartbeat_t.lcm");
}

TEST(Names, OfAllOutcomesAreInTheTablesThatExplainThem) {
  for (const char* words : kWords<FlightOutcome>) {
    EXPECT_THAT(text_of("docs/reference/summary.md"), ::testing::HasSubstr("`" + std::string(words) + "`"));
  }
  for (std::size_t k = 0; k < kPlanOutcomes; ++k) {
    const std::string outcome = key(static_cast<PlanOutcome>(k));
    EXPECT_THAT(text_of("docs/reference/summary.md"), ::testing::HasSubstr("`" + outcome + "`"));
    EXPECT_THAT(text_of("docs/results/table.py"), ::testing::HasSubstr("\"" + outcome + "\""));
  }
}

TEST(Names, OfRefusalsAreTheReasonsThatHeartbeatCounts) {
  std::string reasons;
  for (const char* words : kWords<Rejection>) reasons += (reasons.empty() ? "" : ", ") + std::string(words);
  std::string comments;  // of all lines, as one text
  for (const char c : text_of("lcmtypes/channel_counters_t.lcm")) {
    if (c != '/' && (c != ' ' || !comments.ends_with(' '))) comments += c == '\n' ? ' ' : c;
  }
  const auto twice = [](char a, char b) { return a == ' ' && b == ' '; };
  comments.erase(std::unique(comments.begin(), comments.end(), twice), comments.end());
  EXPECT_THAT(comments, ::testing::HasSubstr("By reason: " + reasons));
}

TEST(Names, OfKeysHaveNoBlanks) {
  EXPECT_STREQ(to_string(PlanOutcome::SearchOnly), "search only");
  EXPECT_EQ(key(PlanOutcome::SearchOnly), "search_only");
}

template <class E>
void expect_found_by_words() {
  for (std::size_t k = 0; k < kWords<E>.size(); ++k) EXPECT_EQ(named<E>(kWords<E>[k]), static_cast<E>(k));
  EXPECT_EQ(named<E>(""), std::nullopt);
}

TEST(Names, LeadBackToTheEnumerator) {
  expect_found_by_words<FlightOutcome>();
  expect_found_by_words<GoalMode>();
  expect_found_by_words<VoxelLabel>();
}

}  // namespace
}  // namespace tern
