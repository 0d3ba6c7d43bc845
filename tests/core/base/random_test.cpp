#include "core/base/random.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

namespace tern {
namespace {

TEST(Rng, DrawsTheSameNumbersEverywhere) {
  // The standard fixes the 10000th number of mt19937_64 with seed 5489: 9981545732273789042.
  Rng rng(5489);
  for (int i = 1; i < 10000; ++i) rng.uniform();
  EXPECT_EQ(rng.uniform(), static_cast<double>(9981545732273789042ULL >> 11) / 9007199254740992.0);
}

RC_GTEST_PROP(Rng, StaysInItsHalfOpenRange, (std::uint64_t seed)) {
  Rng rng(seed);
  for (int i = 0; i < 1000; ++i) {
    const double unit = rng.uniform();
    RC_ASSERT(unit >= 0.0 && unit < 1.0);
    const double ranged = rng.uniform(-3.0, 5.0);
    RC_ASSERT(ranged >= -3.0 && ranged < 5.0);
  }
}

TEST(Rng, NormalDrawsHaveMeanZeroAndVarianceOne) {
  Rng rng(1);
  constexpr int kDraws = 100'000;
  double sum = 0.0;
  double squares = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    const double x = rng.normal();
    sum += x;
    squares += x * x;
  }
  // Five standard errors: 1/√n of the mean, √(2/n) of the variance.
  EXPECT_NEAR(sum / kDraws, 0.0, 5.0 / std::sqrt(kDraws));
  EXPECT_NEAR(squares / kDraws, 1.0, 5.0 * std::sqrt(2.0 / kDraws));
}

}  // namespace
}  // namespace tern
