#include "core/base/percentiles.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

namespace tern {
namespace {

TEST(Percentiles, AreNanOfNothing) {
  const Percentiles p = percentiles({});
  EXPECT_TRUE(std::isnan(p.p50) && std::isnan(p.p95) && std::isnan(p.p99) && std::isnan(p.max));
}

TEST(Percentiles, OfOneToAHundredAreThemselves) {
  std::vector<double> samples;
  for (int i = 100; i >= 1; --i) samples.push_back(i);
  const Percentiles p = percentiles(samples);
  EXPECT_EQ(p.p50, 50.0);
  EXPECT_EQ(p.p95, 95.0);
  EXPECT_EQ(p.p99, 99.0);
  EXPECT_EQ(p.max, 100.0);
}

/// Oracle: the smallest sample that at least `percent` % of all samples do not exceed, by counting.
double by_counting(const std::vector<double>& samples, double percent) {
  double best = INFINITY;
  for (const double x : samples) {
    const auto below = std::count_if(samples.begin(), samples.end(), [x](double y) { return y <= x; });
    if (static_cast<double>(below) * 100.0 >= percent * static_cast<double>(samples.size())) best = std::min(best, x);
  }
  return best;
}

RC_GTEST_PROP(Percentiles, AgreeWithCounting, ()) {
  const auto numbers = *rc::gen::nonEmpty(rc::gen::container<std::vector<int>>(rc::gen::inRange(0, 50)));
  const std::vector<double> samples(numbers.begin(), numbers.end());
  const Percentiles p = percentiles(samples);
  RC_ASSERT(p.p50 == by_counting(samples, 50));
  RC_ASSERT(p.p95 == by_counting(samples, 95));
  RC_ASSERT(p.p99 == by_counting(samples, 99));
  RC_ASSERT(p.max == by_counting(samples, 100));
}

}  // namespace
}  // namespace tern
