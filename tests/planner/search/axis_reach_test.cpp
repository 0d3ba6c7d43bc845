#include "planner/search/axis_reach.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "core/base/random.h"
#include "core/base/types.h"
#include "tests/support/effort.h"
#include "tests/support/random_splines.h"
#include "tests/support/reach_program.h"

namespace tern {
namespace {

using oracle::ReachProgram;

const auto kComparisons = static_cast<std::uint64_t>(support::at_effort(4000));
constexpr std::uint64_t kChains = 5000;  // cheap, and few of them reach the bound

ReachProgram random_program(Rng& rng) {
  ReachProgram p;
  p.intervals = support::random_integer(rng, 4, 12);
  p.interval_s = rng.uniform(0.03, 0.5);
  p.v_max = rng.uniform(0.5, 8.0);
  p.a_max = rng.uniform(1.0, 25.0);
  p.j_max = rng.uniform() < 0.5 ? 1e30 : rng.uniform(5.0, 200.0);
  return p;
}

AxisReach reach_of(const ReachProgram& p) {
  const double j_max = p.j_max > 1e20 ? std::numeric_limits<double>::infinity() : p.j_max;
  return {p.intervals, p.interval_s, p.v_max, p.a_max, j_max};
}

/// The same programme with limits that are a little wider or narrower.
ReachProgram scaled(ReachProgram p, double factor) {
  p.v_max *= factor;
  p.a_max *= factor;
  p.j_max *= factor;
  return p;
}

TEST(AxisReach, NextVelocityIsExactlyWhatTheLinearProgrammeAllows) {
  int compared = 0;
  int impossible = 0;
  for (std::uint64_t seed = 1; seed <= kComparisons; ++seed) {
    Rng rng(seed);
    const ReachProgram p = random_program(rng);
    const AxisReach reach = reach_of(p);
    const int l = support::random_integer(rng, 1, p.intervals - 1);
    const double v = rng.uniform(-1.0, 1.0) * p.v_max;
    const double a = rng.uniform(-1.0, 1.0) * p.a_max;
    const AxisReach::Interval got = reach.next_velocity(l, v, a);
    const auto wider = oracle::next_velocity(scaled(p, 1.0 + 1e-5), l, v, a);
    const auto narrower = oracle::next_velocity(scaled(p, 1.0 - 1e-5), l, v, a);
    if (!wider) {
      ++impossible;
      ASSERT_TRUE(got.empty()) << "seed " << seed;
    }
    if (!narrower || !wider) continue;
    ++compared;
    ASSERT_FALSE(got.empty()) << "seed " << seed;
    const auto exact = oracle::next_velocity(p, l, v, a);
    ASSERT_TRUE(exact) << "seed " << seed;
    EXPECT_NEAR(got.low, exact->low, 1e-6) << "seed " << seed;
    EXPECT_NEAR(got.high, exact->high, 1e-6) << "seed " << seed;
  }
  EXPECT_GT(compared, support::at_effort(1000));
  EXPECT_GT(impossible, support::at_effort(500));
}

/// A chain of velocities from rest or from a random finishable state.
struct Chain {
  bool finished = true;
  double worst = 0.0;  ///< by how much a limit was broken at most, relative
  double end_v = 0.0, end_a = 0.0;
  double way = 0.0;  ///< Σ v_k Δt from `from` on
};

/// Chooses v_2 … v_J from v_1, a_0: mostly ends of the intervals, sometimes values inside.
Chain walk(Rng& rng, const ReachProgram& p, const AxisReach& reach, double v, double a) {
  Chain chain;
  for (int l = 1; l < p.intervals; ++l) {
    const AxisReach::Interval range = reach.next_velocity(l, v, a);
    if (range.empty()) {
      chain.finished = false;
      return chain;
    }
    const double draw = rng.uniform();
    const double next = draw < 0.4 ? range.low : draw < 0.8 ? range.high : rng.uniform(range.low, range.high);
    const double next_a = (next - v) / p.interval_s;
    chain.worst = std::max({chain.worst, std::abs(next) / p.v_max - 1.0, std::abs(next_a) / p.a_max - 1.0,
                            std::abs(next_a - a) / (p.j_max * p.interval_s) - 1.0});
    chain.way += next * p.interval_s;
    v = next;
    a = next_a;
  }
  chain.worst = std::max(chain.worst, std::abs(a) / (p.j_max * p.interval_s) - 1.0);
  chain.end_v = v;
  return chain;
}

TEST(AxisReach, FromEveryVelocityItAllowsRestIsReachedWithinTheLimits) {
  int walks = 0;
  for (std::uint64_t seed = 1; seed <= kChains; ++seed) {
    Rng rng(seed);
    const ReachProgram p = random_program(rng);
    const AxisReach reach = reach_of(p);
    const double v = rng.uniform() < 0.3 ? 0.0 : rng.uniform(-1.0, 1.0) * p.v_max;
    const double a = rng.uniform() < 0.3 ? 0.0 : rng.uniform(-1.0, 1.0) * p.a_max;
    if (reach.next_velocity(1, v, a).empty()) continue;
    ++walks;
    const Chain chain = walk(rng, p, reach, v, a);
    ASSERT_TRUE(chain.finished) << "seed " << seed;
    ASSERT_LE(chain.worst, 0.1 * 1e-6) << "seed " << seed;  // a tenth of kLimitTolerance
    ASSERT_NEAR(chain.end_v, 0.0, 1e-8) << "seed " << seed;
  }
  EXPECT_GT(walks, 1500);
}

TEST(AxisReach, NoChainGoesFartherThanTheDisplacementBound) {
  double closest = 1.0;
  for (std::uint64_t seed = 1; seed <= kChains; ++seed) {
    Rng rng(seed);
    const ReachProgram p = random_program(rng);
    const AxisReach reach = reach_of(p);
    const double v = rng.uniform() < 0.5 ? 0.0 : rng.uniform(-1.0, 1.0) * p.v_max;
    if (reach.next_velocity(1, v, 0.0).empty()) continue;
    // q_2 is where v_1 has led; what follows is Σ v_l Δt for l = 2 … J − 1, and v_J = 0.
    const Chain chain = walk(rng, p, reach, v, 0.0);
    const AxisReach::Interval bound = reach.displacement(2, v);
    ASSERT_GE(chain.way, bound.low - 1e-7) << "seed " << seed;
    ASSERT_LE(chain.way, bound.high + 1e-7) << "seed " << seed;
    if (p.j_max > 1e20 && bound.high > 0.1) closest = std::min(closest, 1.0 - chain.way / bound.high);
  }
  EXPECT_LT(closest, 1e-6);  // without a jerk limit the bound is reached
}

/// Every step may use the wider limits: the states after it have such a step again.
TEST(AxisReach, NoChainOfStepsBeforeTheRestGoesFartherThanTheDisplacementBound) {
  double closest = 1.0;
  int nearer = 0;  // than the bound that knows of no jerk limit
  for (std::uint64_t seed = 1; seed <= kChains; ++seed) {
    Rng rng(seed);
    const ReachProgram p = random_program(rng);
    const AxisReach rest = reach_of(p);
    AxisReach step;
    const double a_max = p.a_max * rng.uniform(1.0, 3.0);
    step.assign_before(rest, a_max, rng.uniform() < 0.5 ? std::numeric_limits<double>::infinity() : 2.0 * p.j_max);
    const double v_1 = rng.uniform() < 0.5 ? 0.0 : rng.uniform(-1.0, 1.0) * p.v_max;
    if (step.next_velocity(1, v_1, 0.0).empty()) continue;
    const double fast = rng.uniform();  // the share of choices that go as far as they can
    std::vector<double> v{0.0, v_1};
    for (int l = 1; l < p.intervals; ++l) {
      const double v_l = v[idx(l)];
      const AxisReach::Interval range = step.next_velocity(l, v_l, l == 1 ? 0.0 : (v_l - v[idx(l - 1)]) / p.interval_s);
      ASSERT_FALSE(range.empty()) << "seed " << seed << ", step " << l;
      v.push_back(rng.uniform() < fast ? range.high : rng.uniform(range.low, range.high));
    }
    double way = 0.0;
    for (int l = p.intervals - 1; l >= 2; --l) {
      way += v[idx(l)] * p.interval_s;
      const AxisReach::Interval bound = step.displacement(l, v[idx(l - 1)]);
      ASSERT_GE(way, bound.low - 1e-7) << "seed " << seed << ", from " << l;
      ASSERT_LE(way, bound.high + 1e-7) << "seed " << seed << ", from " << l;
      if (bound.high > 0.1) closest = std::min(closest, 1.0 - way / bound.high);
    }
    const AxisReach wide(p.intervals, p.interval_s, p.v_max, a_max, std::numeric_limits<double>::infinity());
    nearer += step.displacement(2, v_1).high < 0.9 * wide.displacement(2, v_1).high ? 1 : 0;
  }
  EXPECT_LT(closest, 1e-6);
  EXPECT_GT(nearer, 1000);
}

TEST(AxisReach, TheBoundShrinksToNothingAtTheEnd) {
  const AxisReach reach(6, 0.2, 6.0, 20.0, std::numeric_limits<double>::infinity());
  EXPECT_EQ(reach.displacement(6, 0.0).low, 0.0);
  EXPECT_EQ(reach.displacement(6, 0.0).high, 0.0);
}

TEST(AxisReach, WhatCannotBrakeInTimeHasNoNextVelocity) {
  const AxisReach reach(6, 0.05, 6.0, 5.0, std::numeric_limits<double>::infinity());
  EXPECT_TRUE(reach.next_velocity(1, 6.0, 0.0).empty());
  EXPECT_FALSE(reach.next_velocity(1, 1.0, 0.0).empty());
}

TEST(AxisReach, TheLastStepIsTheOneToRest) {
  const AxisReach reach(6, 0.2, 6.0, 20.0, std::numeric_limits<double>::infinity());
  const AxisReach::Interval last = reach.next_velocity(5, 1.5, -2.0);
  EXPECT_NEAR(last.low, 0.0, 1e-9);
  EXPECT_NEAR(last.high, 0.0, 1e-9);
}

}  // namespace
}  // namespace tern
