#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "campaign/statistics/distribution.h"
#include "campaign/statistics/log_histogram.h"
#include "campaign/statistics/wilson.h"

namespace tern {
namespace {

TEST(Wilson, IsThePublishedInterval) {
  // R: prop.test(k, n, correct = FALSE)$conf.int; 81 of 263 is Newcombe's (1998) example.
  const auto expect = [](std::int64_t k, std::int64_t n, double low, double high) {
    const Interval i = wilson_interval(k, n);
    EXPECT_NEAR(i.low, low, 5e-5) << k << " of " << n;
    EXPECT_NEAR(i.high, high, 5e-5) << k << " of " << n;
  };
  expect(81, 263, 0.2553, 0.3662);
  expect(15, 148, 0.0624, 0.1605);
  expect(0, 20, 0.0, 0.1611);
  expect(1, 29, 0.0061, 0.1718);
  expect(10, 10, 0.7225, 1.0);
  expect(1000, 1000, 0.9962, 1.0);
}

TEST(Wilson, SaysNothingOfNoFlights) {
  EXPECT_EQ(wilson_interval(0, 0).low, 0.0);
  EXPECT_EQ(wilson_interval(0, 0).high, 1.0);
}

TEST(Wilson, RefusesMoreSuccessesThanFlights) { EXPECT_THROW(wilson_interval(3, 2), std::invalid_argument); }

RC_GTEST_PROP(Wilson, EndsSolveTheScoreEquation, ()) {
  const auto n = *rc::gen::inRange<std::int64_t>(1, 10'000);
  const auto k = *rc::gen::inRange<std::int64_t>(0, n + 1);
  const Interval interval = wilson_interval(k, n);
  const double rate = static_cast<double>(k) / static_cast<double>(n);
  RC_ASSERT(interval.low >= 0.0 && interval.low <= rate && rate <= interval.high && interval.high <= 1.0);
  for (const double p : {interval.low, interval.high}) {
    if (p == 0.0 || p == 1.0) continue;
    const double z = std::abs(rate - p) / std::sqrt(p * (1.0 - p) / static_cast<double>(n));
    RC_ASSERT(std::abs(z - kNormalQuantile95) < 1e-6);
  }
  const Interval mirrored = wilson_interval(n - k, n);
  RC_ASSERT(std::abs(mirrored.low - (1.0 - interval.high)) < 1e-12);
}

/// Nearest rank, by counting.
double percentile_by_counting(const std::vector<double>& numbers, int percent) {
  std::vector<double> candidates = numbers;
  std::sort(candidates.begin(), candidates.end());
  for (const double candidate : candidates) {
    const auto below = std::count_if(numbers.begin(), numbers.end(), [&](double x) { return x <= candidate; });
    if (100 * below >= percent * static_cast<std::ptrdiff_t>(numbers.size())) return candidate;
  }
  return candidates.back();
}

std::vector<double> random_times() {
  return *rc::gen::nonEmpty(rc::gen::container<std::vector<double>>(
      rc::gen::map(rc::gen::inRange(0, 10'000'000), [](int k) { return k * 1e-4; })));
}

RC_GTEST_PROP(Distribution, PercentilesAreThoseOfCounting, ()) {
  const std::vector<double> numbers = random_times();
  const Distribution d = describe(numbers);
  RC_ASSERT(d.p50 == percentile_by_counting(numbers, 50));
  RC_ASSERT(d.p95 == percentile_by_counting(numbers, 95));
  RC_ASSERT(d.p99 == percentile_by_counting(numbers, 99));
  RC_ASSERT(d.min == *std::min_element(numbers.begin(), numbers.end()));
  RC_ASSERT(d.max == *std::max_element(numbers.begin(), numbers.end()));
}

TEST(Distribution, LeavesOutWhatHasNoValue) {
  const Distribution d = describe({std::nan(""), 2.0, 4.0, std::nan("")});
  EXPECT_EQ(d.count, 2);
  EXPECT_EQ(d.mean, 3.0);
  EXPECT_TRUE(std::isnan(describe({std::nan("")}).mean));
}

RC_GTEST_PROP(LogHistogram, PercentilesAreWithinOnePercentOfSorting, ()) {
  const std::vector<double> numbers = random_times();
  LogHistogram histogram;
  for (const double x : numbers) histogram.add(x);
  const Distribution exact = describe(numbers), binned = histogram.describe();
  RC_ASSERT(binned.count == exact.count);
  RC_ASSERT(binned.min == exact.min && binned.max == exact.max);
  const auto near = [](double a, double b) { return std::abs(a - b) <= 0.01 * std::max(a, b) + LogHistogram::kMin; };
  RC_ASSERT(near(binned.mean, exact.mean));
  RC_ASSERT(near(binned.p50, exact.p50) && near(binned.p95, exact.p95) && near(binned.p99, exact.p99));
}

RC_GTEST_PROP(LogHistogram, MergedPartsAreTheWholeAndTextsReadBackEqual, ()) {
  LogHistogram whole, left, right;
  bool to_left = true;
  for (const double x : random_times()) {
    const double dyadic = std::floor(x * 1024.0) / 1024.0;  // sums of these are exact
    whole.add(dyadic);
    (to_left ? left : right).add(dyadic);
    to_left = !to_left;
  }
  left.merge(right);
  RC_ASSERT(left == whole);
  const auto read = LogHistogram::parse(whole.to_text());
  RC_ASSERT(read.has_value());
  RC_ASSERT(*read == whole);
}

TEST(LogHistogram, ReadsNothingButWhatItWrote) {
  EXPECT_TRUE(LogHistogram::parse("").has_value());
  for (const char* text : {"x", "1", "1 2 3", "2 2 1 1 7:1", "1 2 2 2 7", "1 2 2 2 7:0", "1 2 2 2 7:1x", "1 2 2 2"}) {
    EXPECT_FALSE(LogHistogram::parse(text).has_value()) << text;
  }
}

}  // namespace
}  // namespace tern
