#include "core/splines/clamped_spline.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/splines/piecewise_cubic.h"
#include "tests/support/de_boor.h"
#include "tests/support/random_splines.h"

namespace tern {
namespace {

RC_GTEST_PROP(ClampedSpline, SamplesWhatDeBoorSays, (std::uint64_t seed)) {
  Rng rng(seed);
  const int intervals = support::random_integer(rng, 1, 12);
  const ClampedSpline spline(support::random_control_points(rng, intervals), rng.uniform(0.05, 1.0));
  for (int i = 0; i <= 200; ++i) {
    const double t = spline.duration_s() * (i / 200.0);
    RC_ASSERT((spline.sample(t).p - oracle::de_boor(spline.control_points(), spline.interval_s(), t)).norm() < 1e-11);
  }
}

RC_GTEST_PROP(ClampedSpline, DerivativesAgreeWithFiniteDifferences, (std::uint64_t seed)) {
  Rng rng(seed);
  const ClampedSpline spline = support::random_spline(rng);
  const double dt = spline.interval_s();
  const double h = 1e-3 * dt;
  for (int i = 0; i < 50; ++i) {
    // Within one interval the curve is one cubic, and central differences have an error of at most j·h²/6.
    const double t = (support::random_integer(rng, 0, spline.intervals() - 1) + rng.uniform(0.01, 0.99)) * dt;
    const MotionSample low = spline.sample(t - h);
    const MotionSample mid = spline.sample(t);
    const MotionSample high = spline.sample(t + h);
    const double truncation = mid.j.norm() * h * h / 6.0;
    RC_ASSERT(((high.p - low.p) / (2.0 * h) - mid.v).norm() <= truncation + 1e-12 * 100.0 / h);
    RC_ASSERT(((high.v - low.v) / (2.0 * h) - mid.a).norm() <= 1e-12 * (1.0 + mid.v.norm()) / h);
    RC_ASSERT(((high.a - low.a) / (2.0 * h) - mid.j).norm() <= 1e-12 * (1.0 + mid.a.norm()) / h);
  }
}

RC_GTEST_PROP(ClampedSpline, IsTwiceContinuouslyDifferentiableAtKnots, (std::uint64_t seed)) {
  Rng rng(seed);
  const ClampedSpline spline = support::random_spline(rng);
  for (int j = 0; j + 1 < spline.intervals(); ++j) {
    const MotionSample left = sample_cubic(spline.power(j), 1.0);
    const MotionSample right = sample_cubic(spline.power(j + 1), 0.0);
    RC_ASSERT((left.p - right.p).norm() < 1e-12);
    RC_ASSERT((left.v - right.v).norm() < 1e-12);
    RC_ASSERT((left.a - right.a).norm() < 1e-12);
  }
}

RC_GTEST_PROP(ClampedSpline, StartsWithTheStateOfItsStartControlPoints, (std::uint64_t seed)) {
  Rng rng(seed);
  Points q = support::random_control_points(rng, support::random_integer(rng, 2, 12));
  const double dt = rng.uniform(0.05, 1.0);
  const MotionSample start{
      support::random_vector(rng, 100.0), support::random_vector(rng, 10.0), support::random_vector(rng, 20.0), {}};
  q.leftCols<3>() = start_control_points(start, dt);
  const MotionSample sampled = ClampedSpline(q, dt).sample(0.0);
  RC_ASSERT((sampled.p - start.p).norm() == 0.0);
  RC_ASSERT((sampled.v - start.v).norm() < 1e-11);
  RC_ASSERT((sampled.a - start.a).norm() < 1e-9);
}

RC_GTEST_PROP(ClampedSpline, EndsAtRestIfItsLastThreeControlPointsCoincide, (std::uint64_t seed)) {
  Rng rng(seed);
  Points q = support::random_control_points(rng, support::random_integer(rng, 4, 12));
  const Eigen::Index n = q.cols() - 1;
  q.col(n - 2) = q.col(n - 1) = q.col(n);
  const ClampedSpline spline(q, rng.uniform(0.05, 1.0));
  RC_ASSERT(spline.ends_at_rest());
  const MotionSample end = spline.sample(spline.duration_s());
  RC_ASSERT((end.p - q.col(n)).norm() < 1e-12);
  RC_ASSERT(end.v.norm() < 1e-11);
  RC_ASSERT(end.a.norm() < 1e-9);
  for (const Eigen::Index moved : {n - 2, n - 1, n}) {
    Points other = q;
    other(1, moved) = std::nextafter(other(1, moved), std::numeric_limits<double>::infinity());
    RC_ASSERT(!ClampedSpline(other, 1.0).ends_at_rest());
  }
}

TEST(ClampedSpline, RestsAtItsLastPointPastItsEndAndThrowsBeforeItsStart) {
  Rng rng(3);
  const ClampedSpline spline = support::random_spline(rng);
  const MotionSample late = spline.sample(spline.duration_s() + 1.0);
  EXPECT_EQ(late.p, Vec3(spline.control_points().rightCols<1>()));
  EXPECT_EQ(late.v, Vec3::Zero());
  EXPECT_EQ(late.a, Vec3::Zero());
  EXPECT_EQ(late.j, Vec3::Zero());
  EXPECT_THROW(static_cast<void>(spline.sample(-1e-9)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(spline.sample(std::nan(""))), std::invalid_argument);
}

TEST(ClampedSpline, GivesTheJerkOfTheIntervalThatStartsAtAKnot) {
  Rng rng(4);
  for (const double dt : {0.1, 0.3, 0.7, 1.0 / 3.0}) {
    const ClampedSpline spline(support::random_control_points(rng, 12), dt);
    for (int j = 0; j < 12; ++j) {
      const Vec3 expected = 6.0 * spline.power(j).col(0) / (dt * dt * dt);
      EXPECT_EQ(spline.sample(j * dt).j, expected) << "dt = " << dt << ", knot " << j;
    }
  }
}

TEST(ClampedSpline, RefusesWhatIsNotASpline) {
  const Points q = Points::Zero(3, 7);
  EXPECT_NO_THROW(ClampedSpline(q, 0.1));
  EXPECT_THROW(ClampedSpline(Points::Zero(3, 3), 0.1), std::invalid_argument);
  EXPECT_THROW(ClampedSpline(Points::Zero(3, kMaxIntervals + 4), 0.1), std::invalid_argument);
  EXPECT_THROW(ClampedSpline(q, 0.0), std::invalid_argument);
  EXPECT_THROW(ClampedSpline(q, std::nan("")), std::invalid_argument);
  Points broken = q;
  broken(2, 5) = std::nan("");
  EXPECT_THROW(ClampedSpline(broken, 0.1), std::invalid_argument);
  const ClampedSpline spline(q, 0.1);
  EXPECT_THROW(static_cast<void>(spline.minvo(4)), std::out_of_range);
  EXPECT_THROW(static_cast<void>(spline.minvo(0, 0.5, 0.5)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(spline.minvo(0, 0.0, 1.5)), std::invalid_argument);
  EXPECT_THROW(start_control_points({}, 0.0), std::invalid_argument);
}

RC_GTEST_PROP(MinvoParts, ContainTheirPartOfTheCurve, (std::uint64_t seed)) {
  Rng rng(seed);
  const ClampedSpline spline = support::random_spline(rng);
  for (int j = 0; j < spline.intervals(); ++j) {
    const double a = rng.uniform();
    const double b = rng.uniform();
    const double u0 = std::min(a, b);
    const double u1 = std::max(a, b);
    RC_PRE(u0 < u1);
    const Points4 v = spline.minvo(j, u0, u1);
    const Vec3 direction = support::random_vector(rng, 1.0);
    for (int i = 0; i <= 50; ++i) {
      const Vec3 p = sample_cubic(spline.power(j), u0 + (u1 - u0) * (i / 50.0)).p;
      RC_ASSERT(direction.dot(p) <= (direction.transpose() * v).maxCoeff() + 1e-11);
    }
  }
}

RC_GTEST_PROP(MinvoParts, ShrinkOntoTheCurve, (std::uint64_t seed)) {
  Rng rng(seed);
  const ClampedSpline spline = support::random_spline(rng);
  for (int j = 0; j < spline.intervals(); ++j) {
    RC_ASSERT((spline.minvo(j, 0.0, 1.0) - spline.minvo(j)).cwiseAbs().maxCoeff() < 1e-12);
    const Vec3 p = sample_cubic(spline.power(j), 0.25).p;
    RC_ASSERT((spline.minvo(j, 0.25, 0.25 + 1e-6).colwise() - p).cwiseAbs().maxCoeff() < 1e-4);
  }
}

RC_GTEST_PROP(MotionBounds, AreReachedAndNeverExceeded, (std::uint64_t seed)) {
  Rng rng(seed);
  const ClampedSpline spline = support::random_spline(rng);
  const MotionBounds all = motion_bounds(spline);
  constexpr int kSamples = 200;
  const double h = spline.interval_s() / kSamples;
  MotionBounds largest;
  for (int j = 0; j < spline.intervals(); ++j) {
    MotionBounds dense;
    for (int i = 0; i <= kSamples; ++i) {
      MotionSample s = sample_cubic(spline.power(j), static_cast<double>(i) / kSamples);
      const double dt = spline.interval_s();
      dense.v_max = dense.v_max.cwiseMax(s.v.cwiseAbs() / dt);
      dense.a_max = dense.a_max.cwiseMax(s.a.cwiseAbs() / (dt * dt));
      dense.j_max = dense.j_max.cwiseMax(s.j.cwiseAbs() / (dt * dt * dt));
    }
    const MotionBounds exact = motion_bounds(spline, j);
    const Vec3 missed = exact.j_max * (h * h / 8.0);  // a parabola's vertex between two samples
    RC_ASSERT(((dense.v_max - exact.v_max).array() <= 1e-12 * (1.0 + exact.v_max.array())).all());
    RC_ASSERT(((exact.v_max - dense.v_max - missed).array() <= 1e-12 * (1.0 + exact.v_max.array())).all());
    RC_ASSERT((exact.a_max - dense.a_max).norm() <= 1e-12 * exact.a_max.norm());
    RC_ASSERT((exact.j_max - dense.j_max).norm() <= 1e-12 * exact.j_max.norm());
    largest.v_max = largest.v_max.cwiseMax(exact.v_max);
    largest.a_max = largest.a_max.cwiseMax(exact.a_max);
    largest.j_max = largest.j_max.cwiseMax(exact.j_max);
  }
  RC_ASSERT(all.v_max == largest.v_max);
  RC_ASSERT(all.a_max == largest.a_max);
  RC_ASSERT(all.j_max == largest.j_max);
}

RC_GTEST_PROP(PositionBounds, AreTheTightBoxOfTheCurve, (std::uint64_t seed)) {
  Rng rng(seed);
  const ClampedSpline spline = support::random_spline(rng);
  constexpr int kSamples = 200;
  for (int j = 0; j < spline.intervals(); ++j) {
    const PowerCubic c = spline.power(j);
    Box dense;
    for (int i = 0; i <= kSamples; ++i) dense.extend(sample_cubic(c, static_cast<double>(i) / kSamples).p);
    const Box exact = spline.position_bounds(j);
    const Vec3 missed = max_abs_acceleration(c, 0.0, 1.0) / (8.0 * kSamples * kSamples);
    RC_ASSERT(((exact.min() - dense.min()).array() <= 1e-12).all());
    RC_ASSERT(((dense.max() - exact.max()).array() <= 1e-12).all());
    RC_ASSERT(((dense.min() - exact.min() - missed).array() <= 1e-12).all());
    RC_ASSERT(((exact.max() - dense.max() - missed).array() <= 1e-12).all());
  }
}

TEST(AtRest, NeverMoves) {
  const Vec3 p(1234.5678, -0.1, 3.3);
  const ClampedSpline spline = at_rest(p, 6, 0.3);
  EXPECT_TRUE(spline.ends_at_rest());
  EXPECT_EQ(spline.sample(0.77).p, p);
  const MotionBounds bounds = motion_bounds(spline);
  EXPECT_EQ(bounds.v_max, Vec3::Zero());
  EXPECT_EQ(bounds.a_max, Vec3::Zero());
  EXPECT_EQ(bounds.j_max, Vec3::Zero());
  EXPECT_EQ(spline.position_bounds(2).min(), p);
  EXPECT_EQ(spline.position_bounds(2).max(), p);
  EXPECT_EQ(spline.minvo(5), Points4(p.replicate<1, 4>()));
}

}  // namespace
}  // namespace tern
