// The auditor's arithmetic against core's: they share no code, so each is the other's oracle.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "core/geometry/box.h"
#include "core/geometry/distance.h"
#include "tests/support/random_splines.h"
#include "tools/audit/body_gap.h"
#include "tools/audit/cubic.h"
#include "tools/audit/plan_case.h"

namespace tern::audit {
namespace {

using support::random_control_points;
using support::random_cubic;
using support::random_integer;
using support::random_vector;

RC_GTEST_PROP(AuditCurves, OfASplineAreTheSpline, (std::uint64_t seed)) {
  Rng rng(seed);
  const int intervals = random_integer(rng, 4, 12);
  const TimedSpline timed{UTime{1'000'000}, Duration{random_integer(rng, 50'000, 1'000'000)},
                          random_control_points(rng, intervals)};
  const std::vector<Curve> curves = curves_of(timed);
  RC_ASSERT(static_cast<int>(curves.size()) == intervals);
  for (int k = 0; k < 20; ++k) {
    const UTime t =
        timed.start + Duration{random_integer(rng, 0, static_cast<int>((timed.end() - timed.start).us) - 1)};
    const MotionSample ours = motion_at(curves, t);
    const MotionSample core = timed.sample(t);
    const double dt = timed.interval.seconds();
    RC_ASSERT((ours.p - core.p).norm() < 1e-10);
    RC_ASSERT((ours.v - core.v).norm() * dt < 1e-10);
    RC_ASSERT((ours.a - core.a).norm() * dt * dt < 1e-10);
  }
}

RC_GTEST_PROP(AuditEnclosure, HoldsEveryValueAndIsTight, (std::uint64_t seed)) {
  Rng rng(seed);
  const PowerCubic c = random_cubic(rng);
  const Cubic cubic{{c(0, 3), c(0, 2), c(0, 1), c(0, 0)}};
  const double a = rng.uniform(-2.0, 2.0);
  const double b = a + rng.uniform(0.0, 3.0);
  const Enclosure e = enclose(cubic, a, b, 1e-6);
  double low = cubic(a), high = cubic(a);
  for (int k = 0; k <= 3000; ++k) {
    const double value = cubic(a + (b - a) * k / 3000.0);
    low = std::min(low, value);
    high = std::max(high, value);
  }
  RC_ASSERT(e.low <= low + 1e-12);
  RC_ASSERT(e.high >= high - 1e-12);
  RC_ASSERT(low - e.low < 1e-4);
  RC_ASSERT(e.high - high < 1e-4);
}

RC_GTEST_PROP(AuditGap, EnclosesTheDistanceFromAPolytopeToABox, (std::uint64_t seed)) {
  Rng rng(seed);
  Body body;
  body.radius = rng.uniform(0.0, 0.3);
  body.vertices = Points(3, random_integer(rng, 2, 12));
  for (int k = 0; k < body.vertices.cols(); ++k) body.vertices.col(k) = random_vector(rng, 0.5);
  const Vec3 p = random_vector(rng, 3.0);
  const Vec3 half = random_vector(rng, 1.0).cwiseAbs();
  const Points at_p = body.vertices.colwise() + p;
  const Gap gap = body_gap(body, p, half);
  const double exact = distance(box_corners(box_around(Vec3::Zero(), half)), at_p) - body.radius;
  RC_ASSERT(gap.low <= gap.high);
  RC_ASSERT(gap.low <= exact + 1e-6);
  RC_ASSERT(gap.high >= exact - 2e-6);
  RC_ASSERT(gap.high - gap.low < 1e-3);
}

TEST(AuditGap, OfASphereIsItsDepthInOverlap) {
  const Body body{.radius = 0.25};
  EXPECT_DOUBLE_EQ(body_gap(body, {2.0, 0.0, 0.0}, {1.0, 1.0, 1.0}).high, 0.75);
  EXPECT_DOUBLE_EQ(body_gap(body, {0.9, 0.0, 0.0}, {1.0, 1.0, 1.0}).high, -0.35);
  EXPECT_NEAR(body_gap(body, {2.0, 2.0, 1.0}, {1.0, 1.0, 1.0}).low, std::sqrt(2.0) - 0.25, 1e-15);
}

TEST(AuditHermite, ErrsByAnEighthOfTheJumpTimesTheSpanWhereVelocityJumpsInTheMiddle) {
  // Straight at 1 m/s, and from the middle of a second on at 2 m/s: the worst case of the bound in true_motion.h.
  const Curve curve =
      hermite(UTime{0}, Vec3::Zero(), Vec3::UnitX(), UTime{1'000'000}, 1.5 * Vec3::UnitX(), 2.0 * Vec3::UnitX());
  EXPECT_NEAR(curve.p(0.5).x() - 0.5, 1.0 / 8.0, 1e-15);
}

TEST(AuditPredictedBox, OfTwoPiecesThatMeetTheLaterOneRules) {
  Track track;
  CubicPiece piece;
  piece.duration = Duration{100'000};
  track.motion.start = UTime{1'000'000};
  track.motion.pieces = {piece, piece};
  track.alpha = {Vec3::Constant(0.5), Vec3::Constant(0.1)};
  const PredictedBox box(track, track.alpha);
  const UTime joint = track.motion.start + piece.duration;
  for (const double to : {0.0, 0.05}) {
    const auto stretches = box.stretches(joint, 0.0, to);
    ASSERT_EQ(stretches.size(), 1U) << to;
    EXPECT_EQ(stretches.front().half, track.alpha[1]);
  }
  EXPECT_EQ(box.stretches(joint, -0.05, 0.05).size(), 2U);
  EXPECT_EQ(box.stretches(joint + piece.duration, 0.0, 0.0).size(), 1U) << "its end";
}

}  // namespace
}  // namespace tern::audit
