#include "planner/duration.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/random.h"
#include "tests/support/random_splines.h"

namespace tern {
namespace {

/// Oracle: the least time over many cruising speeds u: from v0 to u, cruise for the remaining distance, then brake to
/// 0.
double brute_force(double d, double v0, double v_max, double a) {
  double best = INFINITY;
  constexpr int kSpeeds = 200'000;
  for (int k = -kSpeeds; k <= kSpeeds; ++k) {
    const double u = v_max * k / kSpeeds;
    const double ramps = std::abs(u - v0) / a + std::abs(u) / a;
    const double way = 0.5 * (u + v0) * std::abs(u - v0) / a + 0.5 * u * std::abs(u) / a;
    const double rest = d - way;
    const double cruise = k != 0 ? rest / u : std::abs(rest) < 1e-9 ? 0.0 : INFINITY;
    if (cruise >= 0.0) best = std::min(best, ramps + cruise);
  }
  return best;
}

TEST(MinTimeToRest, MatchesABruteForceOverCruisingSpeeds) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Rng rng(seed);
    const double v_max = rng.uniform(1.0, 8.0);
    const double a = rng.uniform(2.0, 20.0);
    const double v0 = rng.uniform() < 0.2 ? 0.0 : rng.uniform(-1.3, 1.3) * v_max;
    const double d = rng.uniform() < 0.5 ? rng.uniform(-20.0, 20.0) : rng.uniform(-2.0, 2.0);
    EXPECT_NEAR(min_time_to_rest(d, v0, v_max, a), brute_force(d, v0, v_max, a), 2e-3)
        << "d " << d << " v0 " << v0 << " v_max " << v_max << " a " << a;
  }
}

TEST(MinTimeToRest, KnowsTheClosedCases) {
  EXPECT_DOUBLE_EQ(min_time_to_rest(0.0, 0.0, 6.0, 20.0), 0.0);
  EXPECT_DOUBLE_EQ(min_time_to_rest(1.0, 0.0, 100.0, 4.0), 1.0);                       // 2 √(d/a)
  EXPECT_DOUBLE_EQ(min_time_to_rest(6.0, 0.0, 2.0, 4.0), 3.5);                         // d/v + v/a
  EXPECT_DOUBLE_EQ(min_time_to_rest(2.0, 4.0, 6.0, 4.0), 1.0);                         // just brakes: v²/(2a) = d
  EXPECT_DOUBLE_EQ(min_time_to_rest(0.0, 4.0, 6.0, 4.0), 1.0 + 2.0 * std::sqrt(0.5));  // brakes and comes back 2 m
}

TEST(MinTimeToRest, IsTheSameInTheMirror) {
  for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
    Rng rng(seed);
    const double d = rng.uniform(-9.0, 9.0);
    const double v0 = rng.uniform(-7.0, 7.0);
    EXPECT_DOUBLE_EQ(min_time_to_rest(d, v0, 6.0, 10.0), min_time_to_rest(-d, -v0, 6.0, 10.0));
  }
}

TEST(MinDuration, IsTheSlowestAxisWhereJerkIsFree) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Rng rng(seed);
    MotionSample start;
    start.p = support::random_vector(rng, 5.0);
    start.v = support::random_vector(rng, 6.0);
    const Vec3 to = support::random_vector(rng, 5.0);
    const Limits limits;
    double slowest = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      slowest = std::max(
          slowest, min_time_to_rest(to[axis] - start.p[axis], start.v[axis], limits.v_max[axis], limits.a_max[axis]));
    }
    EXPECT_EQ(min_duration(start, to, limits), slowest);
    Limits jerky = limits;
    jerky.j_max = Vec3::Constant(50.0);
    EXPECT_GE(min_duration(start, to, jerky), slowest);
  }
}

}  // namespace
}  // namespace tern
