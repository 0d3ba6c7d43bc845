#include "planner/safety/interval_separation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/geometry/distance.h"
#include "core/geometry/separation.h"
#include "tests/support/planner_worlds.h"
#include "tests/support/random_splines.h"

namespace tern {
namespace {

using namespace support;

constexpr UTime kOrigin{50'000'000};
const Box kEverywhere(Vec3::Constant(-1e4), Vec3::Constant(1e4));
const Box kWhere(Vec3(-2.5, -2.5, -1.5), Vec3(2.5, 2.5, 1.5));

/// A trajectory among a few movers, cut into its own intervals.
struct Scene {
  std::vector<Track> tracks;
  std::vector<PlanningObstacle> obstacles;
  Body body;
  TimedSpline trajectory;
  std::vector<double> times;
};

Scene random_scene(std::uint64_t seed) {
  Rng rng(seed);
  Scene s;
  for (int id = 1; id <= 3; ++id) {
    const UTime from = kOrigin - Duration{random_integer(rng, 0, 300'000)};
    s.tracks.push_back(rng.uniform() < 0.7 ? random_mover(rng, id, kWhere, from, 1.5)
                                           : jumping_mover(rng, id, kWhere, from, 1.5));
    if (rng.uniform() < 0.2) s.tracks.back().kind = TrackKind::Static;
  }
  s.obstacles = obstacles_of(s.tracks);
  s.obstacles.push_back({-1, nullptr, box_around(random_vector(rng, 2.0), Vec3::Constant(0.3)), {}});
  s.body = body_of(kBodyKinds[random_integer(rng, 0, 2)]);
  s.trajectory = random_trajectory(rng, random_vector(rng, 1.5), kOrigin, Limits{});
  for (int j = 0; j <= s.trajectory.spline().intervals(); ++j) s.times.push_back(j * s.trajectory.interval.seconds());
  return s;
}

bool is_separated(SeparationCache& cache, int interval, const PowerCubic& power) {
  PairCounts counts;
  std::vector<CertificatePlane> planes;
  return separate_interval(cache, interval, power, counts, planes).ok;
}

TEST(SeparateInterval, NeverCertifiesACollisionFoundByDenseSampling) {
  int passed = 0;
  int met = 0;
  for (std::uint64_t seed = 1; seed <= 600; ++seed) {
    const Scene s = random_scene(seed);
    const ClampedSpline spline = s.trajectory.spline();
    const SweptObstacles swept(s.obstacles, s.body, kOrigin, s.times, kEverywhere);
    SeparationCache cache(swept);
    for (int j = 0; j < spline.intervals(); ++j) {
      const bool ok = is_separated(cache, j, spline.power(j));
      const UTime from = kOrigin + s.trajectory.interval * j;
      const double gap =
          least_gap(s.trajectory, s.body, s.obstacles, from, from + s.trajectory.interval, Duration{5'000});
      if (gap == 0.0) ++met;
      if (!ok) continue;
      ++passed;
      ASSERT_GT(gap, 0.0) << "seed " << seed << ", interval " << j;
    }
  }
  EXPECT_GT(passed, 500);
  EXPECT_GT(met, 150);
}

TEST(SeparateInterval, PassesWhateverStaysWellClear) {
  int clear = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const Scene s = random_scene(seed);
    const ClampedSpline spline = s.trajectory.spline();
    const SweptObstacles swept(s.obstacles, s.body, kOrigin, s.times, kEverywhere);
    SeparationCache cache(swept);
    for (int j = 0; j < spline.intervals(); ++j) {
      double least = INFINITY;
      for (const auto& neighbour : swept.neighbours(j))
        least = std::min(least, distance(cache.hull(neighbour, {j, 0, 1}), spline.minvo(j)));
      if (least <= s.body.radius + 2.0 * kTouchingTolerance) continue;
      ++clear;
      ASSERT_TRUE(is_separated(cache, j, spline.power(j))) << "seed " << seed << ", interval " << j;
    }
  }
  EXPECT_GT(clear, 200);
}

TEST(SeparateInterval, EveryPlaneHoldsTheHullOnOneSideAndThePartOnTheOther) {
  int planes_seen = 0;
  int split = 0;
  for (std::uint64_t seed = 1; seed <= 600; ++seed) {
    const Scene s = random_scene(seed);
    const ClampedSpline spline = s.trajectory.spline();
    const SweptObstacles swept(s.obstacles, s.body, kOrigin, s.times, kEverywhere);
    SeparationCache cache(swept);
    PairCounts counts;
    std::vector<CertificatePlane> planes;
    if (seed % 2 == 0) {
      for (int j = 0; j < spline.intervals(); ++j) separate_interval(cache, j, spline.power(j), counts, planes);
    } else {
      find_planes(cache, spline, HullBasis::Minvo, 1.0, counts, planes);
    }
    for (const CertificatePlane& c : planes) {
      const TimePart part{c.interval, c.part, c.parts};
      ++planes_seen;
      split += part.of > 1 ? 1 : 0;
      ASSERT_NEAR(c.plane.n.norm(), 1.0, 1e-12);
      const auto& neighbours = swept.neighbours(part.interval);
      const auto of = std::find_if(neighbours.begin(), neighbours.end(),
                                   [&](const auto& neighbour) { return swept.obstacle(neighbour).id == c.track; });
      ASSERT_NE(of, neighbours.end());
      const Points& hull = cache.hull(*of, part);
      for (Eigen::Index k = 0; k < hull.cols(); ++k) ASSERT_GE(c.plane.signed_distance(hull.col(k)), 0.0);
      const Points4 curve = spline.minvo(part.interval, part.u0(), part.u1());
      for (int k = 0; k < 4; ++k) {
        ASSERT_LE(c.plane.signed_distance(curve.col(k)), -std::max(s.body.radius, kPlaneMargin)) << "seed " << seed;
      }
    }
  }
  EXPECT_GT(planes_seen, 1000);
  EXPECT_GT(split, 20);
}

TEST(IsClear, SaysWhatSeparateIntervalSays) {
  int clear = 0;
  int blocked = 0;
  PairCounts counts;
  for (std::uint64_t seed = 1; seed <= 600; ++seed) {
    const Scene s = random_scene(seed);
    const ClampedSpline spline = s.trajectory.spline();
    const SweptObstacles swept(s.obstacles, s.body, kOrigin, s.times, kEverywhere);
    SeparationCache planes(swept), asked(swept);
    for (int j = 0; j < spline.intervals(); ++j) {
      const bool ok = is_separated(planes, j, spline.power(j));
      // A second call, with the memory of the first, gives the same result.
      for (int k = 0; k < 2; ++k) {
        ASSERT_EQ(is_separated(asked, j, spline.power(j), spline.minvo(j), counts), ok) << "seed " << seed << ", " << j;
      }
      ++(ok ? clear : blocked);
    }
    EXPECT_EQ(asked.hulls_made(), 0);
  }
  EXPECT_GT(clear, 500);
  EXPECT_GT(blocked, 150);
  EXPECT_GT(std::min({counts.by_box, counts.by_cache, counts.by_instant, counts.by_plane}), 100);
}

TEST(SeparateInterval, SplitsTheIntervalInTimeWhereOnePlaneDoesNotDo) {
  // The vehicle comes along x to the origin's far side; the mover was at the origin when it set out, and leaves along
  // y.
  const std::vector<Track> tracks{straight_mover(7, Vec3::Zero(), Vec3(0, 12, 0), 0.3, kOrigin, 1.0)};
  const auto obstacles = obstacles_of(tracks);
  const SweptObstacles swept(obstacles, Body{}, kOrigin, {0.0, 0.5}, kEverywhere);
  SeparationCache cache(swept);
  PowerCubic along_x = PowerCubic::Zero();
  along_x.col(2) = Vec3(3, 0, 0);
  along_x.col(3) = Vec3(-1.5, 0, 0);
  EXPECT_LT(distance(cache.hull(swept.neighbours(0)[0], {0, 0, 1}), minvo_points(along_x)), 1e-9);
  EXPECT_LT(distance(cache.hull(swept.neighbours(0)[0], {0, 0, 2}), HullForm{}.points(0, along_x, 0.0, 0.5)), 1e-9);
  EXPECT_TRUE(is_separated(cache, 0, along_x));
}

TEST(SeparateInterval, NamesWhatBlocks) {
  const std::vector<Track> tracks{straight_mover(7, Vec3(9, 0, 0), Vec3::Zero(), 0.3, kOrigin, 1.0),
                                  straight_mover(8, Vec3(0.5, 0, 0), Vec3::Zero(), 0.3, kOrigin, 1.0)};
  const auto obstacles = obstacles_of(tracks);
  const SweptObstacles swept(obstacles, Body{}, kOrigin, {0.0, 0.5}, kEverywhere);
  SeparationCache cache(swept);
  PairCounts counts;
  std::vector<CertificatePlane> planes;
  const Separated result = separate_interval(cache, 0, PowerCubic::Zero(), counts, planes);
  EXPECT_TRUE(result.ok);
  PowerCubic there = PowerCubic::Zero();
  there.col(3) = Vec3(0.4, 0, 0);
  const Separated blocked = separate_interval(cache, 0, there, counts, planes);
  EXPECT_FALSE(blocked.ok);
  EXPECT_EQ(blocked.blocker, 8);
}

TEST(ClearTimeAt, TheBodyTouchesNothingAsLongAsItSays) {
  int cut = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    const Scene s = random_scene(seed);
    const SweptObstacles swept(s.obstacles, s.body, kOrigin, s.times, kEverywhere);
    SeparationCache cache(swept);
    const int first = static_cast<int>(seed % 3);
    const Vec3 p = s.trajectory.control_points.col(0);
    PairCounts counts;
    const double clear = clear_time_at(cache, first, p, counts).seconds;
    const double whole = s.times.back() - swept.time(first);
    ASSERT_LE(clear, whole + 1e-12);
    if (clear > 0.0) {
      const UTime from = kOrigin + Duration::from_seconds(swept.time(first));
      const UTime to = from + Duration::from_seconds(clear);
      ASSERT_GT(least_gap(resting_at(p, from), s.body, s.obstacles, from, to), 0.0) << "seed " << seed;
    }
    if (clear < whole - 1e-9) {
      // The interval in which it ends really has a hull at the body.
      ++cut;
      int k = first;
      while (swept.time(k) - swept.time(first) < clear - 1e-9) ++k;
      double nearest = INFINITY;
      for (const auto& neighbour : swept.neighbours(k))
        nearest = std::min(nearest, distance(cache.hull(neighbour, {k, 0, 1}), Points(p)));
      ASSERT_LE(nearest, s.body.radius + 2.0 * kTouchingTolerance) << "seed " << seed;
    }
  }
  EXPECT_GT(cut, 50);
  EXPECT_LT(cut, 290);
}

TEST(ClearTimeAt, AFullHoldLastsWhateverTheTimeBeforeIt) {
  int less = 0;
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    Rng rng(seed);
    const double duration = rng.uniform(0.1, 3.0);
    const double hold = random_integer(rng, 1, 30) * 0.1;
    const std::vector<double> times = {0.0, duration, duration + hold};
    const SweptObstacles swept({}, Body{}, kOrigin, times, kEverywhere);
    SeparationCache cache(swept);
    PairCounts counts;
    const double clear = clear_time_at(cache, 1, Vec3::Zero(), counts).seconds;
    if (clear < hold) ++less;
    ASSERT_TRUE(lasts(clear, hold)) << "seed " << seed;
    ASSERT_FALSE(lasts(clear, hold + 1e-6)) << "seed " << seed;
  }
  EXPECT_GT(less, 100) << "rounding was not met";
}

TEST(HullForm, APartsPointsHoldThatPartOfTheCurve) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Rng rng(seed);
    const PowerCubic cubic = random_cubic(rng);
    const double u0 = rng.uniform() < 0.3 ? 0.0 : rng.uniform(0.0, 0.9);
    const double u1 = rng.uniform() < 0.3 ? 1.0 : rng.uniform(u0 + 0.05, 1.0);
    const Points4 points = HullForm{}.points(0, cubic, u0, u1);
    for (int i = 0; i <= 20; ++i) {
      const Vec3 p = sample_cubic(cubic, u0 + (u1 - u0) * i / 20).p;
      ASSERT_LE(distance(points, Points(p)), 1e-9) << "seed " << seed;
    }
  }
}

}  // namespace
}  // namespace tern
