#include "predictor/models/forecast.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/predictor/simulated_motion.h"

namespace tern {
namespace {

AxisFilter random_filter(Rng& rng) {
  const double xx = rng.uniform(1e-4, 0.1), vv = rng.uniform(0.01, 4.0);
  return {rng.normal(), 2.0 * rng.normal(), xx, rng.uniform(0.0, 0.9) * std::sqrt(xx * vv), vv};
}

std::array<AxisForecast, 3> forecasts(const std::array<AxisFilter, 3>& axes, double q, const PredictionSpec& spec) {
  return {forecast(axes[0], q, spec), forecast(axes[1], q, spec), forecast(axes[2], q, spec)};
}

TEST(PieceEnds, CoverTheHorizonWithPiecesThatGrow) {
  const std::vector<Duration> ends = piece_ends(PredictionSpec{});
  EXPECT_EQ(ends.size(), 12u);
  EXPECT_EQ(ends.front(), Duration{});
  EXPECT_EQ(ends[1], Duration{250'000});
  EXPECT_EQ(ends.back(), Duration{4'500'000});
  for (std::size_t k = 1; k < ends.size(); ++k) EXPECT_LT(ends[k - 1], ends[k]);
}

TEST(CrossingIntegral, MatchesFineQuadrature) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    Rng rng(seed);
    const AxisFilter filter = random_filter(rng);
    const double q = rng.uniform(1e-4, 10.0), horizon = 4.5;
    double sum = 0.0;
    const int n = 200'000;
    for (int i = 0; i < n; ++i) {
      AxisFilter p = filter;
      p.predict(horizon * (i + 0.5) / n, q);
      sum += std::sqrt(p.xx * p.vv - p.xv * p.xv) / p.xx * horizon / n;
    }
    EXPECT_NEAR(crossing_integral(filter, q, horizon), sum, 2e-3 * sum) << "seed " << seed;
  }
}

TEST(Quantile, IsTheNormalOneWithoutCrossings) {
  EXPECT_NEAR(quantile_for(0.05, 0.0), 1.959964, 1e-6);
  EXPECT_NEAR(quantile_for(0.01 / 3.0, 0.0), 2.935199, 1e-6);
  EXPECT_GT(quantile_for(0.01 / 3.0, 3.0), 3.3);
}

// Many error paths of one axis: how often does one leave ±zσ(t) at any time?
TEST(EscapeProbability, BoundsTheShareOfPathsThatLeave) {
  const AxisFilter start{0.0, 0.0, 0.001, 0.005, 0.2};
  const double q = 1.0, horizon = 4.5, dt = 0.005;
  for (const double z : {2.0, 2.5, 3.0}) {
    Rng rng(static_cast<std::uint64_t>(z * 10));
    const int trials = 3000;
    int left = 0;
    for (int trial = 0; trial < trials; ++trial) {
      double x = std::sqrt(start.xx) * rng.normal();
      double v = start.xv / start.xx * x + std::sqrt(start.vv - start.xv * start.xv / start.xx) * rng.normal();
      AxisFilter p = start;
      bool out = std::abs(x) > z * std::sqrt(p.xx);
      for (double t = 0.0; t < horizon && !out; t += dt) {
        const double dv = std::sqrt(q * dt) * rng.normal();
        x += v * dt + 0.5 * dt * dv + std::sqrt(q * dt * dt * dt / 12.0) * rng.normal();
        v += dv;
        p.predict(dt, q);
        out = std::abs(x) > z * std::sqrt(p.xx);
      }
      left += out ? 1 : 0;
    }
    const double bound = escape_probability(z, crossing_integral(start, q, horizon));
    EXPECT_LE(testing::wilson(left, trials).low, bound) << "z " << z;
    // Not far above either: most paths that leave do so once.
    EXPECT_GE(testing::wilson(left, trials).high, 0.4 * bound) << "z " << z;
  }
}

TEST(AxisTube, GrowsNoFasterThanTheSpeedLimitAndNeverShrinks) {
  const PredictionSpec spec;
  const std::vector<Duration> ends = piece_ends(spec);
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    Rng rng(seed);
    const AxisFilter filter = random_filter(rng);
    const AxisTube tube = axis_tube(forecast(filter, rng.uniform(1e-4, 20.0), spec), 0.01 / 3.0, spec);
    const double speed = std::max(spec.max_speed, std::abs(filter.v));
    for (std::size_t k = 1; k < ends.size(); ++k) {
      const double dt = (ends[k] - ends[k - 1]).seconds();
      EXPECT_GE(tube.half[k], tube.half[k - 1]) << "seed " << seed;
      EXPECT_LE(tube.half[k] - tube.half[k - 1], speed * dt + 1e-9) << "seed " << seed;
      EXPECT_LE(std::abs(tube.centre[k] - tube.centre[k - 1]), speed * dt + 1e-9) << "seed " << seed;
    }
  }
}

TEST(PredictMotion, FollowsTheLineWhereNoSpeedLimitBites) {
  PredictionSpec spec;
  spec.max_speed = 1e3;
  const std::array<AxisFilter, 3> axes{AxisFilter{1.0, 2.0, 0.01, 0.0, 0.1}, AxisFilter{0.0, -1.0, 0.01, 0.0, 0.1},
                                       AxisFilter{5.0, 0.0, 0.01, 0.0, 0.1}};
  Track track;
  predict_motion(forecasts(axes, 1.0, spec), testing::at_seconds(10.0), spec, track);
  EXPECT_EQ(track.motion.end(), testing::at_seconds(14.5));
  for (double t = 0.0; t <= 4.5; t += 0.1) {
    const Vec3 p = track.motion.sample(testing::at_seconds(10.0 + t)).p;
    EXPECT_LT((p - Vec3(1.0 + 2.0 * t, -t, 5.0)).norm(), 1e-9);
  }
  EXPECT_EQ(track.alpha.size(), track.motion.pieces.size());
  EXPECT_EQ(track.top_speed, 1e3);
}

// Whatever stays in the filter's tube, and under the speed limit, stays in the pieces: the region at every instant.
TEST(PredictMotion, PiecesContainTheRegionBetweenTheirEnds) {
  const PredictionSpec spec;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    Rng rng(seed);
    const AxisFilter filter = random_filter(rng);
    const double q = rng.uniform(1e-4, 20.0);
    const double speed = std::max(spec.max_speed, std::abs(filter.v));
    const double z = quantile_for((1.0 - spec.confidence) / 3.0, crossing_integral(filter, q, 4.5));
    Track track;
    predict_motion(forecasts({filter, filter, filter}, q, spec), UTime{}, spec, track);
    const double dt = 0.001;
    double high = filter.x + z * std::sqrt(filter.xx), low = filter.x - z * std::sqrt(filter.xx);
    for (int i = 0; i < 4500; ++i) {
      const double t = i * dt;
      AxisFilter p = filter;
      p.predict(t, q);
      high = i == 0 ? high : std::min(p.x + z * std::sqrt(p.xx), high + speed * dt);
      low = i == 0 ? low : std::max(p.x - z * std::sqrt(p.xx), low - speed * dt);
      const UTime now = testing::at_seconds(t);
      const double centre = track.motion.sample(now).p.x(), alpha = track.alpha[track.motion.locate(now).index].x();
      ASSERT_LE(high, centre + alpha + 1e-6) << "seed " << seed << ", t " << t;
      ASSERT_GE(low, centre - alpha - 1e-6) << "seed " << seed << ", t " << t;
    }
  }
}

}  // namespace
}  // namespace tern
