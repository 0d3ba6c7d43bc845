#include "core/world/flyable.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/world/names.h"
#include "core/world/thrust.h"
#include "tests/support/flat_outputs.h"
#include "tests/support/random_splines.h"

namespace tern {
namespace {

using support::flat_outputs;
using support::FlatOutputs;
using support::random_integer;
using support::random_vector;

/// Returns a spline that ends at rest, with accelerations of some m/s², sometimes above gravity.
TimedSpline random_plan(Rng& rng) {
  TimedSpline plan;
  plan.interval = Duration{random_integer(rng, 100'000, 400'000)};
  const int intervals = random_integer(rng, 4, 9);
  const double dt = plan.interval.seconds();
  plan.control_points.resize(3, intervals + 3);
  plan.control_points.col(0) = random_vector(rng, 50.0);
  for (int i = 1; i < intervals + 3; ++i) {
    plan.control_points.col(i) = plan.control_points.col(i - 1) + random_vector(rng, rng.uniform(1.0, 9.0) * dt * dt);
  }
  plan.control_points.rightCols<2>() = plan.control_points.col(intervals).replicate(1, 2);
  return plan;
}

const Box kEverywhere(Vec3::Constant(-1e4), Vec3::Constant(1e4));

BreachReport judged(const TimedSpline& plan, const Dynamics& dynamics) {
  const Vec3 any = Vec3::Constant(std::numeric_limits<double>::infinity());
  Limits limits{any, any, any};
  limits.dynamics = dynamics;
  return breach_of(plan, plan.start, plan.sample(plan.start), limits, kEverywhere);
}

TEST(ThrustBounds, AreWhatDenselySampledFlatOutputsReach) {
  int turned = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    Rng rng(seed);
    const ClampedSpline spline = random_plan(rng).spline();
    ThrustBounds all{1e9};
    for (int j = 0; j < spline.intervals(); ++j) {
      const ThrustBounds b = thrust_bounds(spline, j);
      all = {std::min(all.min_thrust, b.min_thrust), std::max(all.max_thrust, b.max_thrust),
             std::max(all.slope, b.slope), std::max(all.body_rate, b.body_rate)};
    }
    const FlatOutputs sampled = flat_outputs(spline, 2000);
    ASSERT_NEAR(all.max_thrust, sampled.max_thrust, 1e-9) << "seed " << seed;
    ASSERT_LE(all.min_thrust, sampled.min_thrust + 1e-9) << "seed " << seed;
    ASSERT_NEAR(all.min_thrust, sampled.min_thrust, 1e-2) << "seed " << seed;
    if (std::isfinite(all.slope)) {
      ASSERT_NEAR(to_degrees(std::atan(all.slope)), sampled.tilt_deg, 1e-6) << "seed " << seed;
    } else {
      ASSERT_GE(sampled.tilt_deg, 90.0 - 1e-9) << "seed " << seed;
    }
    ASSERT_GE(to_degrees(all.body_rate), sampled.rate_deg_s * (1.0 - 1e-6)) << "seed " << seed;
    if (all.min_thrust < 3.0) continue;  // near free fall the rate's peak is narrower than a sample
    ++turned;
    ASSERT_NEAR(to_degrees(all.body_rate), sampled.rate_deg_s, 0.01 * sampled.rate_deg_s + 1e-6) << "seed " << seed;
  }
  EXPECT_GT(turned, 100);
}

TEST(ThrustBounds, OfAHoverAreGravityAlone) {
  const ThrustBounds b = thrust_bounds(Vec3::Zero(), Vec3::Zero(), 0.1);
  EXPECT_EQ(b.min_thrust, kGravity);
  EXPECT_EQ(b.max_thrust, kGravity);
  EXPECT_EQ(b.slope, 0.0);
  EXPECT_EQ(b.body_rate, 0.0);
}

TEST(ThrustBounds, ThroughFreeFallTheBodyTurnsAtOnce) {
  const Vec3 fall(0.0, 0.0, -2.0 * kGravity);
  EXPECT_EQ(thrust_bounds(Vec3::Zero(), fall, 0.1).body_rate, std::numeric_limits<double>::infinity());
  EXPECT_EQ(thrust_bounds(Vec3::Zero(), fall, 0.1).slope, std::numeric_limits<double>::infinity());
}

TEST(Flyable, KeepsDynamicsExactlyAsDenseSamplingDoes) {
  int flown[kBreaches] = {};
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    Rng rng(seed);
    const TimedSpline plan = random_plan(rng);
    const Dynamics dynamics = support::random_dynamics(rng);
    const BreachReport report = judged(plan, dynamics);
    const FlatOutputs sampled = flat_outputs(plan.spline());
    // An extremum between samples may exceed them slightly; apart from that, both must agree.
    if (report.ok()) {
      ASSERT_TRUE(sampled.within(dynamics, 1e-5)) << "seed " << seed;
    } else {
      ASSERT_FALSE(sampled.within(dynamics, -0.02)) << "seed " << seed << ": " << report.text();
    }
    ++flown[static_cast<int>(report.breach)];
  }
  for (const Breach breach : {Breach::None, Breach::Thrust, Breach::Tilt, Breach::BodyRate}) {
    EXPECT_GT(flown[static_cast<int>(breach)], 50) << to_string(breach);
  }
}

TEST(Flyable, NamesTheLimitThatIsBrokenWithValueAndLimit) {
  TimedSpline plan;  // from rest 1 m along x and to rest
  plan.interval = Duration{200'000};
  plan.control_points = Points::Zero(3, 9);
  plan.control_points.row(0) << 0, 0, 0, 0.2, 0.5, 0.8, 1, 1, 1;
  const FlatOutputs flown = flat_outputs(plan.spline(), 2000);
  const Dynamics wide{0.9 * flown.min_thrust, 1.1 * flown.max_thrust, 1.1 * flown.tilt_deg, 1.1 * flown.rate_deg_s};
  EXPECT_EQ(judged(plan, wide).breach, Breach::None);
  const auto narrowed = [&](double Dynamics::*limit, double factor) {
    Dynamics dynamics = wide;
    dynamics.*limit *= factor;
    return judged(plan, dynamics);
  };
  EXPECT_EQ(narrowed(&Dynamics::thrust_min, 1.2).breach, Breach::Thrust);
  EXPECT_EQ(narrowed(&Dynamics::thrust_max, 0.9).breach, Breach::Thrust);
  EXPECT_EQ(narrowed(&Dynamics::tilt_max_deg, 0.9).breach, Breach::Tilt);
  const BreachReport turns = narrowed(&Dynamics::body_rate_max_deg_s, 0.9);
  EXPECT_EQ(turns.breach, Breach::BodyRate);
  EXPECT_NEAR(turns.value, flown.rate_deg_s, 0.01 * flown.rate_deg_s);
  EXPECT_NE(turns.text().find("deg/s beyond"), std::string::npos) << turns.text();
}

}  // namespace
}  // namespace tern
