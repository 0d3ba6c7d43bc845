// The committed trajectory: in force by time, the same curve as pieces, at rest in the end.
#include "executor/committed_trajectory.h"

#include <gtest/gtest.h>

#include "core/base/random.h"

namespace tern {
namespace {

constexpr UTime kStart{1'700'000'000'000'000};
constexpr Duration kMs{1'000};

/// A spline from a state to rest at a random distance.
TimedSpline spline_from(Rng& rng, const MotionSample& start, UTime t, Duration interval = kMs * 173) {
  TimedSpline timed{t, interval, Points::Zero(3, 9)};
  timed.control_points.leftCols<3>() = start_control_points(start, interval.seconds());
  for (int k = 3; k < 9; ++k) {
    const Vec3 step(rng.uniform(-1.0, 1.0), rng.uniform(-1.0, 1.0), rng.uniform(-1.0, 1.0));
    timed.control_points.col(k) = timed.control_points.col(k - 1) + (k < 7 ? step : Vec3::Zero());
  }
  return timed;
}

/// Three segments, each starting during the one before; the last one is flown to its end.
CommittedTrajectory three_segments(Rng& rng) {
  CommittedTrajectory committed(Vec3(1.0, 2.0, 3.0), kStart);
  for (int k = 1; k <= 3; ++k) {
    const UTime t = kStart + kMs * 400 * k;
    committed.splice(spline_from(rng, committed.sample(t), t));
  }
  return committed;
}

TEST(CommittedTrajectory, RestsAtItsStartForEver) {
  const CommittedTrajectory committed(Vec3(1.0, 2.0, 3.0), kStart);
  for (const std::int64_t ms : {-5'000, 0, 1, 700, 1'000, 100'000}) {
    const MotionSample sample = committed.sample(kStart + kMs * ms);
    EXPECT_EQ(sample.p, Vec3(1.0, 2.0, 3.0));
    EXPECT_EQ(sample.v, Vec3::Zero());
    EXPECT_EQ(sample.a, Vec3::Zero());
  }
}

TEST(CommittedTrajectory, EachSegmentIsInForceUntilTheNext) {
  Rng rng(1);
  const CommittedTrajectory committed = three_segments(rng);
  EXPECT_EQ(committed.in_force_at(kStart).start, kStart);
  EXPECT_EQ(committed.in_force_at(kStart + kMs * 400 - Duration{1}).start, kStart);
  EXPECT_EQ(committed.in_force_at(kStart + kMs * 400).start, kStart + kMs * 400);
  EXPECT_EQ(committed.in_force_at(kStart + kMs * 90'000).start, kStart + kMs * 1'200);
}

TEST(CommittedTrajectory, PiecesAreTheSameCurve) {
  Rng rng(2);
  const CommittedTrajectory committed = three_segments(rng);
  for (int round = 0; round < 50; ++round) {
    const UTime from = kStart + Duration::from_seconds(rng.uniform(-0.5, 2.5));
    const UTime to = from + Duration::from_seconds(rng.uniform(0.001, 2.0));
    const PiecewiseCubic pieces = committed.pieces(from, to);
    EXPECT_EQ(pieces.start, from);
    EXPECT_EQ(pieces.end(), to);
    for (int k = 0; k < 20; ++k) {
      const UTime t = from + Duration{static_cast<std::int64_t>(rng.uniform() * static_cast<double>((to - from).us))};
      const MotionSample a = committed.sample(t);
      const MotionSample b = pieces.sample(t);
      EXPECT_LT((a.p - b.p).norm(), 1e-12);
      EXPECT_LT((a.v - b.v).norm(), 1e-11);
      EXPECT_LT((a.a - b.a).norm(), 1e-10);
    }
  }
}

TEST(CommittedTrajectory, ForgettingKeepsWhatIsInForce) {
  Rng rng(3);
  CommittedTrajectory committed = three_segments(rng);
  const UTime t = kStart + kMs * 900;
  const MotionSample before = committed.sample(t);
  committed.forget_before(t);
  EXPECT_EQ(committed.segments(), 2U);
  EXPECT_EQ(committed.sample(t).p, before.p);
}

TEST(CommittedTrajectory, RefusesWhatStartsEarlierOrDoesNotRest) {
  Rng rng(4);
  CommittedTrajectory committed = three_segments(rng);
  EXPECT_THROW(committed.splice(spline_from(rng, {}, kStart + kMs * 1'200)), std::invalid_argument);
  TimedSpline restless = spline_from(rng, {}, kStart + kMs * 2'000);
  restless.control_points.col(8).x() += 1e-12;
  EXPECT_THROW(committed.splice(restless), std::invalid_argument);
  EXPECT_THROW((void)committed.pieces(kStart, kStart), std::invalid_argument);
}

}  // namespace
}  // namespace tern
