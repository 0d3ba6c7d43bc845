#include "core/splines/piecewise_cubic.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <stdexcept>

#include "tests/support/random_splines.h"

namespace tern {
namespace {

constexpr UTime kStart{1'700'000'000'000'000};

PiecewiseCubic random_motion(Rng& rng) {
  PiecewiseCubic motion{kStart, {}};
  const int pieces = support::random_integer(rng, 1, 8);
  for (int k = 0; k < pieces; ++k) {
    motion.pieces.push_back({Duration{support::random_integer(rng, 1, 2'000'000)}, support::random_cubic(rng)});
  }
  return motion;
}

RC_GTEST_PROP(PiecewiseCubic, LocatesEveryInstantInTheOnePieceThatHoldsIt, (std::uint64_t seed)) {
  Rng rng(seed);
  const PiecewiseCubic motion = random_motion(rng);
  UTime piece_start = kStart;
  for (std::size_t k = 0; k < motion.pieces.size(); ++k) {
    const Duration length = motion.pieces[k].duration;
    for (const Duration inside : {Duration{0}, Duration{length.us / 2}, length - Duration{1}}) {
      const PiecewiseCubic::Located at = motion.locate(piece_start + inside);
      RC_ASSERT(at.index == k);
      RC_ASSERT(at.start == piece_start);
      const MotionSample expected = sample_cubic(motion.pieces[k].coefficients, inside.seconds());
      RC_ASSERT(motion.sample(piece_start + inside).p == expected.p);
      RC_ASSERT(motion.sample(piece_start + inside).j == expected.j);
    }
    piece_start = piece_start + length;
  }
  RC_ASSERT(motion.end() == piece_start);
}

TEST(PiecewiseCubic, GoesOnWithItsEndPiecesBeyondItsSpan) {
  Rng rng(5);
  PiecewiseCubic motion{kStart, {}};
  for (int k = 0; k < 3; ++k) motion.pieces.push_back({Duration{500'000}, support::random_cubic(rng)});
  const Duration beyond{250'000};
  EXPECT_EQ(motion.sample(kStart - beyond).p, sample_cubic(motion.pieces.front().coefficients, -0.25).p);
  EXPECT_EQ(motion.sample(motion.end()).p, sample_cubic(motion.pieces.back().coefficients, 0.5).p);
  EXPECT_EQ(motion.sample(motion.end() + beyond).p, sample_cubic(motion.pieces.back().coefficients, 0.75).p);
  EXPECT_EQ(motion.locate(motion.end() + beyond).index, 2U);
}

TEST(PiecewiseCubic, RefusesToBeEmpty) {
  const PiecewiseCubic motion{kStart, {}};
  EXPECT_THROW(static_cast<void>(motion.end()), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(motion.locate(kStart)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(motion.sample(kStart)), std::invalid_argument);
}

TEST(SampleCubic, DifferentiatesThePolynomial) {
  PowerCubic c = PowerCubic::Zero();
  c.row(0) << 1, 2, 3, 4;  // t³ + 2t² + 3t + 4 at t = 2
  const MotionSample s = sample_cubic(c, 2.0);
  EXPECT_EQ(s.p, Vec3(26, 0, 0));
  EXPECT_EQ(s.v, Vec3(23, 0, 0));
  EXPECT_EQ(s.a, Vec3(16, 0, 0));
  EXPECT_EQ(s.j, Vec3(6, 0, 0));
}

RC_GTEST_PROP(CubicBounds, AreReachedAndNeverExceeded, (std::uint64_t seed)) {
  Rng rng(seed);
  const PowerCubic c = support::random_cubic(rng);
  const double t0 = rng.uniform(-2.0, 2.0);
  const double t1 = t0 + rng.uniform(0.0, 3.0);
  constexpr int kSamples = 1000;
  const double h = (t1 - t0) / kSamples;
  Box dense;
  Vec3 speed = Vec3::Zero();
  Vec3 acceleration = Vec3::Zero();
  for (int i = 0; i <= kSamples; ++i) {
    const MotionSample s = sample_cubic(c, t0 + i * h);
    dense.extend(s.p);
    speed = speed.cwiseMax(s.v.cwiseAbs());
    acceleration = acceleration.cwiseMax(s.a.cwiseAbs());
  }
  const double rounding = 1e-11;
  const Box exact = cubic_bounds(c, t0, t1);
  const Vec3 a_max = max_abs_acceleration(c, t0, t1);
  const Vec3 v_max = max_abs_velocity(c, t0, t1);
  const Vec3 missed_p = (a_max * (h * h / 8.0)).array() + rounding;
  const Vec3 missed_v = (6.0 * c.col(0).cwiseAbs() * (h * h / 8.0)).array() + rounding;
  RC_ASSERT(grown(exact, Vec3::Constant(rounding)).contains(dense));
  RC_ASSERT(grown(dense, missed_p).contains(exact));
  RC_ASSERT(((speed - v_max).array() <= rounding).all());
  RC_ASSERT(((v_max - speed - missed_v).array() <= 0.0).all());
  RC_ASSERT((acceleration - a_max).cwiseAbs().maxCoeff() <= rounding);
}

TEST(CubicBounds, AreExactForAnInflectionALineAndAPoint) {
  PowerCubic c = PowerCubic::Zero();
  c.row(0) << 1, 0, 0, 0;   // t³: inflection at 0
  c.row(1) << 0, 0, -1, 2;  // 2 − t
  c.row(2) << 0, 0, 0, 7;   // a point
  const Box box = cubic_bounds(c, -1.0, 2.0);
  EXPECT_EQ(box.min(), Vec3(-1, 0, 7));
  EXPECT_EQ(box.max(), Vec3(8, 3, 7));
  EXPECT_EQ(cubic_bounds(c, 0.5, 0.5).min(), Vec3(0.125, 1.5, 7));
}

RC_GTEST_PROP(Reparametrized, IsTheSameCurveOnTheUnitParameter, (std::uint64_t seed)) {
  Rng rng(seed);
  const PowerCubic c = support::random_cubic(rng);
  const double t0 = rng.uniform(-2.0, 2.0);
  const double t1 = t0 + rng.uniform(0.1, 2.0);
  const PowerCubic part = reparametrized(c, t0, t1);
  for (int i = 0; i <= 20; ++i) {
    const double s = i / 20.0;
    RC_ASSERT((sample_cubic(part, s).p - sample_cubic(c, t0 + s * (t1 - t0)).p).norm() < 1e-12);
  }
}

// Per axis A sin(ωt + φ); its fourth derivative is at most A ω⁴.
struct Swing {
  Vec3 amplitude, rate, phase;

  explicit Swing(Rng& rng) : amplitude(support::random_vector(rng, 5.0)), phase(support::random_vector(rng, 3.0)) {
    rate = support::random_vector(rng, 4.0);
  }
  [[nodiscard]] MotionSample at(double t) const {
    MotionSample s;
    for (int k = 0; k < 3; ++k) {
      s.p[k] = amplitude[k] * std::sin(rate[k] * t + phase[k]);
      s.v[k] = amplitude[k] * rate[k] * std::cos(rate[k] * t + phase[k]);
    }
    return s;
  }
};

RC_GTEST_PROP(HermiteFit, StaysWithinItsErrorBound, (std::uint64_t seed)) {
  Rng rng(seed);
  const Swing swing(rng);
  const Duration piece{support::random_integer(rng, 10'000, 1'000'000)};
  const int pieces = support::random_integer(rng, 1, 10);
  const PiecewiseCubic fit = hermite_fit(kStart, piece, pieces, [&](Duration t) { return swing.at(t.seconds()); });
  RC_ASSERT(fit.end() == kStart + piece * pieces);
  for (int i = 0; i <= 500; ++i) {
    const Duration t{(piece * pieces).us * i / 500};
    const Vec3 error = (fit.sample(kStart + t).p - swing.at(t.seconds()).p).cwiseAbs();
    for (int k = 0; k < 3; ++k) {
      const double fourth = std::abs(swing.amplitude[k]) * std::pow(swing.rate[k], 4);
      RC_ASSERT(error[k] <= hermite_error_bound(piece.seconds(), fourth) + 1e-12);
    }
  }
}

RC_GTEST_PROP(HermiteFit, InterpolatesPositionAndVelocityAtItsJoints, (std::uint64_t seed)) {
  Rng rng(seed);
  const Swing swing(rng);
  const Duration piece{support::random_integer(rng, 10'000, 1'000'000)};
  const PiecewiseCubic fit = hermite_fit(kStart, piece, 4, [&](Duration t) { return swing.at(t.seconds()); });
  for (int k = 0; k <= 4; ++k) {
    const MotionSample expected = swing.at((piece * k).seconds());
    const MotionSample sampled = fit.sample(kStart + piece * k);
    RC_ASSERT((sampled.p - expected.p).norm() < 1e-12);
    RC_ASSERT((sampled.v - expected.v).norm() < 1e-11);
  }
}

TEST(HermiteErrorBound, IsReachedByAQuartic) {
  const Duration h{800'000};
  const auto quartic = [](Duration t) {
    const double s = t.seconds();
    MotionSample m;
    m.p.setConstant(s * s * s * s);
    m.v.setConstant(4.0 * s * s * s);
    return m;
  };
  const PiecewiseCubic fit = hermite_fit(kStart, h, 1, quartic);
  const double error = std::abs(fit.sample(kStart + Duration{h.us / 2}).p.x() - std::pow(0.4, 4));
  EXPECT_NEAR(error, hermite_error_bound(0.8, 24.0), 1e-15);
}

TEST(HermiteFit, RefusesNoPiecesAndPiecesWithoutLength) {
  const auto still = [](Duration) { return MotionSample{}; };
  EXPECT_THROW(hermite_fit(kStart, Duration{1000}, 0, still), std::invalid_argument);
  EXPECT_THROW(hermite_fit(kStart, Duration{0}, 1, still), std::invalid_argument);
}

RC_GTEST_PROP(RemainingMotion, IsTheSplineFromThereToItsEnd, (std::uint64_t seed)) {
  Rng rng(seed);
  const Duration interval{support::random_integer(rng, 50'000, 1'000'000)};
  const int intervals = support::random_integer(rng, 4, 12);
  const ClampedSpline spline(support::random_control_points(rng, intervals), interval.seconds());
  const Duration passed{static_cast<std::int64_t>(rng.uniform() * static_cast<double>((interval * intervals).us))};
  const PiecewiseCubic rest = remaining_motion(spline, kStart, kStart + passed);
  RC_ASSERT(rest.start == kStart + passed);
  RC_ASSERT(rest.end() == kStart + interval * intervals);
  for (int i = 0; i < 100; ++i) {
    const Duration t = passed + Duration{(rest.end() - rest.start).us * i / 100};
    const MotionSample expected = spline.sample(t.seconds());
    const MotionSample sampled = rest.sample(kStart + t);
    RC_ASSERT((sampled.p - expected.p).norm() < 1e-11);
    RC_ASSERT((sampled.v - expected.v).norm() < 1e-10 * (1.0 + expected.v.norm()));
    RC_ASSERT((sampled.a - expected.a).norm() < 1e-9 * (1.0 + expected.a.norm()));
  }
}

TEST(RemainingMotion, RefusesTimesOutsideTheSplineAndIntervalsBetweenMicroseconds) {
  const ClampedSpline spline = at_rest(Vec3::Ones(), 4, 0.25);
  EXPECT_NO_THROW(remaining_motion(spline, kStart, kStart));
  EXPECT_THROW(remaining_motion(spline, kStart, kStart - Duration{1}), std::invalid_argument);
  EXPECT_THROW(remaining_motion(spline, kStart, kStart + Duration{1'000'000}), std::invalid_argument);
  EXPECT_THROW(remaining_motion(at_rest(Vec3::Ones(), 4, 0.1234565), kStart, kStart), std::invalid_argument);
}

}  // namespace
}  // namespace tern
