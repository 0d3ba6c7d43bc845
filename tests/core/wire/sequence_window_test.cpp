#include "core/wire/sequence_window.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>
#include <set>
#include <vector>

namespace tern {
namespace {

using Verdict = SequenceWindow::Verdict;

/// Returns a window that received all numbers up to `newest`.
SequenceWindow heard_up_to(std::int64_t newest) {
  SequenceWindow window;
  for (std::int64_t k = newest - 19; k <= newest; ++k) EXPECT_EQ(window.add(k), Verdict::New);
  return window;
}

RC_GTEST_PROP(SequenceWindow, CountsWhatDidNotComeAndHandsOverTheRestOnceWhateverTheNetworkDoes, ()) {
  // Each message is lost, arrives once or arrives twice; it is late by at most six places.
  std::vector<std::pair<int, std::int64_t>> arrivals;
  const int count = *rc::gen::inRange(20, 300);
  std::int64_t lost = 0;
  for (int k = 1; k <= count; ++k) {
    const bool edge = k <= 8 || k > count - 8;  // the first begins the count, the last ends it
    const int times = edge ? 1 : *rc::gen::weightedElement<int>({{1, 0}, {8, 1}, {1, 2}});
    if (times == 0) ++lost;
    for (int i = 0; i < times; ++i) arrivals.emplace_back(edge ? k : k + *rc::gen::inRange(0, 6), k);
  }
  std::stable_sort(arrivals.begin(), arrivals.end(), [](auto& a, auto& b) { return a.first < b.first; });
  SequenceWindow window;
  std::set<std::int64_t> handed_over;
  for (const auto& [when, sequence] : arrivals) {
    const bool is_new = handed_over.insert(sequence).second;
    RC_ASSERT((window.add(sequence) == Verdict::New) == is_new);
  }
  RC_ASSERT(window.lost() == lost);
}

TEST(SequenceWindow, AFalseNumberMovesNothing) {
  const std::int64_t most = std::numeric_limits<std::int64_t>::max();
  for (const std::int64_t lie : {std::int64_t{1}, std::int64_t{103}, std::int64_t{150}, std::int64_t{9'000},
                                 std::int64_t{200'000}, std::int64_t{1} << 62, most}) {
    SequenceWindow window = heard_up_to(100);
    window.add(lie);
    std::int64_t repeated = 0;
    for (std::int64_t k = 101; k <= 300; ++k) repeated += window.add(k) == Verdict::New ? 0 : 1;
    EXPECT_LE(repeated, 1) << lie << ": its own place at most";
    EXPECT_EQ(window.lost(), 0) << lie;
  }
}

TEST(SequenceWindow, AFarNumberIsAJumpAndNoLoss) {
  SequenceWindow window = heard_up_to(100);
  EXPECT_EQ(window.add(std::int64_t{1} << 62), Verdict::Jump);
  EXPECT_EQ(window.lost(), 0);
}

TEST(SequenceWindow, ALongLossIsCountedWhenTheNextNumberConfirmsIt) {
  SequenceWindow window = heard_up_to(100);
  EXPECT_EQ(window.add(1'101), Verdict::New);
  EXPECT_EQ(window.add(1'102), Verdict::New);
  EXPECT_EQ(window.lost(), 1'000);
}

TEST(SequenceWindow, TwoFalseNumbersInARowAreTakenBackWhenTheFormerOnesGoOn) {
  SequenceWindow window = heard_up_to(100);
  window.add(5'000);
  window.add(5'001);
  int refused = 0;
  for (std::int64_t k = 101; k <= 130; ++k) refused += window.add(k) == Verdict::New ? 0 : 1;
  EXPECT_EQ(window.lost(), 0);
  EXPECT_EQ(refused, 0);
}

TEST(SequenceWindow, ManyFalseNumberingsBetweenTrueNumbersLeaveTheCountTrue) {
  SequenceWindow window = heard_up_to(100);
  int refused = 0;
  for (std::int64_t k = 101; k <= 1'000; ++k) {
    for (const std::int64_t bit : {7, 13, 40, 61}) {
      window.add(k + (std::int64_t{1} << bit));
      window.add(k + 1 + (std::int64_t{1} << bit));
    }
    refused += window.add(k) == Verdict::New ? 0 : 1;
  }
  EXPECT_EQ(window.lost(), 0);
  EXPECT_EQ(refused, 0);
}

TEST(SequenceWindow, WhatOneFalseNumberLeftOutIsNotLostHoweverSlowlyTheTrueOnesCome) {
  SequenceWindow window = heard_up_to(100);
  window.add(108);
  for (std::int64_t k = 101; k <= 107; ++k) {
    EXPECT_EQ(window.lost(), 0) << k;
    EXPECT_EQ(window.add(k), Verdict::New);
  }
}

TEST(SequenceWindow, ASenderThatWasHeardAFewTimesMayBeNoise) {
  SequenceWindow window;
  for (const int k : {10, 15, 17}) window.add(k);
  EXPECT_EQ(window.lost(), 0);
  for (const int k : {18, 19}) window.add(k);
  EXPECT_EQ(window.lost(), 5);
}

TEST(SequenceWindow, CopiesOfOldMessagesAreRepetitionsInWhateverOrderTheyCome) {
  SequenceWindow window = heard_up_to(1'000);
  for (const int k : {800, 801, 802, 985, 986, 990, 803, 804, 805, 806})
    EXPECT_EQ(window.add(k), Verdict::Repeated) << k;
  EXPECT_EQ(window.add(1'001), Verdict::New);
  EXPECT_EQ(window.lost(), 0);
}

TEST(SequenceWindow, TellsWhatWasSentBeforeTheFirstThatCame) {
  SequenceWindow window;
  for (const int k : {8, 7, 9, 10}) window.add(k);
  EXPECT_EQ(window.before_first(), 0) << "it may be noise";
  for (const int k : {11, 12}) window.add(k);
  EXPECT_EQ(window.before_first(), 6);
}

TEST(SequenceWindow, NumbersMayBeginAnewWhenTheSenderDoes) {
  SequenceWindow window = heard_up_to(1'000);
  window.restart();
  for (std::int64_t k = 1; k < 50; ++k) EXPECT_EQ(window.add(k), Verdict::New);
  EXPECT_EQ(window.lost(), 0);
}

}  // namespace
}  // namespace tern
