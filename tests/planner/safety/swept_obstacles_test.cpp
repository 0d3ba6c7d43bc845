#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/geometry/box.h"
#include "core/geometry/convex_hull.h"
#include "core/geometry/distance.h"
#include "planner/planning_world.h"
#include "planner/safety/separation_cache.h"
#include "tests/support/planner_worlds.h"
#include "tests/support/random_splines.h"

namespace tern {
namespace {

using namespace support;

const Box kWhere(Vec3(-3, -3, -3), Vec3(3, 3, 3));
const Box kEverywhere(Vec3::Constant(-1e4), Vec3::Constant(1e4));
constexpr UTime kOrigin{50'000'000};
constexpr double kRounding = 1e-9;  // m, of coordinates within tens of metres

/// One obstacle of random motion, α and body, over a random cut of time that may begin before its pieces and end after
/// them.
struct Case {
  std::vector<Track> tracks;
  std::vector<PlanningObstacle> obstacles;
  Body body;
  std::vector<double> times;
};

Case random_case(Rng& rng) {
  Case c;
  const UTime from = kOrigin + Duration{random_integer(rng, -1'500'000, 600'000)};
  const double seconds = rng.uniform(0.8, 3.0);
  c.tracks.push_back(rng.uniform() < 0.5 ? random_mover(rng, 1, kWhere, from, seconds)
                                         : jumping_mover(rng, 1, kWhere, from, seconds));
  if (rng.uniform() < 0.1) c.tracks[0].kind = TrackKind::Static;
  c.obstacles = obstacles_of(c.tracks);
  AlphaShare& count = c.obstacles[0].alpha;
  if (rng.uniform() < 0.3) count.scale = rng.uniform();
  if (rng.uniform() < 0.5) count.level = random_integer(rng, 0, kLevels - 1);
  if (rng.uniform() < 0.5) count.grows_to = static_cast<std::size_t>(random_integer(rng, 0, 4));
  c.body = body_of(kBodyKinds[random_integer(rng, 0, 2)]);
  double t = rng.uniform() < 0.5 ? 0.0 : rng.uniform(0.0, 0.5);
  for (int k = random_integer(rng, 2, 8); k >= 0; --k) {
    c.times.push_back(t);
    t += rng.uniform() < 0.2 ? 0.02 : rng.uniform(0.05, 0.5);
  }
  return c;
}

double support(const Points& points, const Vec3& d) { return (d.transpose() * points).maxCoeff(); }

double true_support(const Case& c, double from, double to, const Vec3& d) {
  const Track& track = c.tracks[0];
  double most = 0.0;
  if (track.kind == TrackKind::Static) {
    const Box box = promised_box(track, kOrigin, c.obstacles[0].alpha);
    most = d.dot(box.center()) + d.cwiseAbs().dot(0.5 * box.sizes());
  } else {
    most = support_of_sweep(track, c.obstacles[0].alpha, kOrigin, from, to, d);
  }
  return most + support(-c.body.vertices, d);
}

/// Calls check(hull, from, to) for the hull of every part of every interval.
template <class Check>
void for_each_hull(const Case& c, Check&& check) {
  const SweptObstacles swept(c.obstacles, c.body, kOrigin, c.times, kEverywhere);
  SeparationCache cache(swept);
  for (int k = 0; k < swept.intervals(); ++k) {
    ASSERT_EQ(swept.neighbours(k).size(), 1u);
    for (const int parts : {1, 2, 4}) {
      for (int part = 0; part < parts; ++part) {
        const double step = (swept.time(k + 1) - swept.time(k)) / parts;
        const double from = swept.time(k) + part * step;
        check(cache.hull(swept.neighbours(k)[0], {k, part, parts}), from, from + step);
      }
    }
  }
}

TEST(SweptObstacles, HullsContainDenseSamplesOfEverySweptInflatedBody) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Rng rng(seed);
    const Case c = random_case(rng);
    for_each_hull(c, [&](const Points& hull, double from, double to) {
      for (int i = 0; i <= 12; ++i) {
        const UTime t = kOrigin + Duration{static_cast<std::int64_t>((from + (to - from) * i / 12) * 1e6)};
        const Duration at = std::clamp(t - kOrigin, Duration::from_seconds(from), Duration::from_seconds(to));
        const Box box = promised_box(c.tracks[0], kOrigin + at, c.obstacles[0].alpha);
        const Eigen::Matrix<double, 3, 8> corners = box_corners(box);
        for (int corner = 0; corner < 8; ++corner) {
          const Points swept = (-c.body.vertices).colwise() + corners.col(corner);
          for (Eigen::Index v = 0; v < swept.cols(); ++v) {
            // Times are rounded to a microsecond here.
            ASSERT_LE(distance(hull, Points(swept.col(v))), 1e-4)
                << "seed " << seed << ", from " << from << " to " << to;
          }
        }
      }
    });
  }
}

TEST(SweptObstacles, HullsHoldTheSweepAndExceedItByNoMoreThanBeta) {
  int checked = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    Rng rng(seed);
    const Case c = random_case(rng);
    for_each_hull(c, [&](const Points& hull, double from, double to) {
      for (int i = 0; i < 12; ++i) {
        const Vec3 d =
            i < 6 ? Vec3((i % 2 == 0 ? 1.0 : -1.0) * Vec3::Unit(i / 2)) : Vec3(random_vector(rng, 1.0).normalized());
        const double is = support(hull, d);
        const double least = true_support(c, from, to, d);
        ASSERT_GE(is, least - kRounding) << "seed " << seed << ", from " << from << " to " << to << ", along "
                                         << d.transpose();
        ASSERT_LE(is, least + kBetaMax * d.lpNorm<1>() + kRounding)
            << "seed " << seed << ", from " << from << " to " << to << ", along " << d.transpose();
        ++checked;
      }
    });
  }
  EXPECT_GT(checked, 50'000);
}

TEST(SweptObstacles, AnAbsurdAccelerationCostsAWiderHullNotMemory) {
  Track track = straight_mover(1, Vec3::Zero(), Vec3::Zero(), 0.4, kOrigin, 1.0);
  track.motion.pieces[0].coefficients.col(1).setConstant(1e9);  // half the acceleration, m/s²
  const std::vector<Track> tracks = {track};
  const auto obstacles = obstacles_of(tracks);
  const Box everywhere(Vec3::Constant(-1e12), Vec3::Constant(1e12));
  const SweptObstacles swept(obstacles, Body{}, kOrigin, std::vector<double>{0.0, 0.5, 1.0}, everywhere);
  SeparationCache cache(swept);
  ASSERT_EQ(swept.neighbours(1).size(), 1u);
  const Points& hull = cache.hull(swept.neighbours(1)[0], {1, 0, 1});
  EXPECT_LT(hull.cols(), 5000);
  for (int i = 0; i <= 1000; ++i) {
    const double t = 0.5 + 0.5 * i / 1000;
    const Vec3 p = Vec3::Constant(1e9 * t * t);
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 d = Vec3::Unit(axis);
      ASSERT_GE(support(hull, d), d.dot(p));
      ASSERT_GE(support(hull, -d), -d.dot(p));
    }
  }
}

TEST(SweptObstacles, HullsHaveNoSuperfluousPoints) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    Rng rng(seed);
    for_each_hull(random_case(rng),
                  [&](const Points& hull, double, double) { ASSERT_EQ(hull_vertices(hull).cols(), hull.cols()); });
  }
}

TEST(SweptObstacles, NeighbourAndPartBoxesHoldTheHullGrownByTheBall) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Rng rng(seed);
    const Case c = random_case(rng);
    const SweptObstacles swept(c.obstacles, c.body, kOrigin, c.times, kEverywhere);
    SeparationCache cache(swept);
    for (int k = 0; k < swept.intervals(); ++k) {
      const SweptObstacles::Neighbour& neighbour = swept.neighbours(k)[0];
      for (const int parts : {1, 2, 4}) {
        for (int part = 0; part < parts; ++part) {
          const Points& hull = cache.hull(neighbour, {k, part, parts});
          const Vec3 ball = Vec3::Constant(c.body.radius - kRounding);
          const Box needed = grown(Box(hull.rowwise().minCoeff(), hull.rowwise().maxCoeff()), ball);
          ASSERT_TRUE(cache.part_box(neighbour, {k, part, parts}).contains(needed)) << "seed " << seed;
          ASSERT_TRUE(neighbour.box.contains(needed)) << "seed " << seed;
        }
      }
    }
  }
}

TEST(SweptObstacles, KeepsEveryObstacleThatTheBodyCanTouchFromTheRegion) {
  int left_out = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Rng rng(seed);
    const Case c = random_case(rng);
    const Box region = box_around(random_vector(rng, 4.0), Vec3::Constant(rng.uniform(0.0, 2.0)));
    const SweptObstacles swept(c.obstacles, c.body, kOrigin, c.times, region);
    SeparationCache cache(swept);
    for (int k = 0; k < swept.intervals(); ++k) {
      if (!swept.neighbours(k).empty()) continue;
      ++left_out;
      for (int i = 0; i <= 40; ++i) {
        const double t = swept.time(k) + (swept.time(k + 1) - swept.time(k)) * i / 40;
        const Box box = promised_box(c.tracks[0], kOrigin + Duration::from_seconds(t), c.obstacles[0].alpha);
        ASSERT_FALSE(grown(box, c.body.half_extents()).intersects(region)) << "seed " << seed << ", t " << t;
      }
    }
  }
  EXPECT_GT(left_out, 100);
}

TEST(SweptObstacles, BoxesThatAPredictionSetBringsSpareWorkAndChangeNothing) {
  int kept = 0, dropped = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    Rng rng(seed);
    Case c = random_case(rng);
    TrackSet set;
    set.tracks = c.tracks;
    const PredictionProducts products(std::move(set));
    std::vector<PlanningObstacle> with = products.obstacles;
    with[0].alpha = c.obstacles[0].alpha;
    std::vector<PlanningObstacle> without = with;
    without[0].boxes = nullptr;
    const Vec3 centre = random_vector(rng, 3.0);
    const Box region(centre - Vec3::Constant(1.5), centre + Vec3::Constant(1.5));
    const SweptObstacles a(with, c.body, kOrigin, c.times, region), b(without, c.body, kOrigin, c.times, region);
    for (int k = 0; k < a.intervals(); ++k) {
      ASSERT_EQ(a.neighbours(k).size(), b.neighbours(k).size()) << "seed " << seed << ", interval " << k;
      if (a.neighbours(k).empty()) {
        ++dropped;
        continue;
      }
      ++kept;
      ASSERT_TRUE(a.neighbours(k)[0].box.isApprox(b.neighbours(k)[0].box, 0.0)) << "seed " << seed;
      ASSERT_EQ(SeparationCache(a).hull(a.neighbours(k)[0], {k, 0, 1}),
                SeparationCache(b).hull(b.neighbours(k)[0], {k, 0, 1}))
          << "seed " << seed;
    }
  }
  EXPECT_GT(kept, 200);
  EXPECT_GT(dropped, 200);
}

TEST(SweptObstacles, BeforeItsFirstPieceAndAfterItsLastATrackIsAGrowingBox) {
  const Track track = straight_mover(1, Vec3(1, 0, 0), Vec3(2, 0, 0), 0.5, kOrigin + Duration{1'000'000}, 1.0);
  const std::vector<Track> tracks{track};
  const auto obstacles = obstacles_of(tracks);
  const SweptObstacles swept(obstacles, Body{}, kOrigin, {0.25, 0.5, 2.5, 3.0}, kEverywhere);
  SeparationCache cache(swept);
  const Points& before = cache.hull(swept.neighbours(0)[0], {0, 0, 1});
  EXPECT_NEAR(support(before, Vec3(1, 0, 0)), 1.0 + 0.5 + 2.0 * 0.75, kRounding);
  EXPECT_NEAR(support(before, Vec3(0, 0, -1)), 0.5 + 2.0 * 0.75, kRounding);
  const Points& after = cache.hull(swept.neighbours(2)[0], {2, 0, 1});
  EXPECT_NEAR(support(after, Vec3(1, 0, 0)), 3.0 + 0.5 + 2.0, kRounding);
  EXPECT_NEAR(support(after, Vec3(0, 1, 0)), 0.5 + 2.0, kRounding);
}

TEST(SweptObstacles, BoxesOfTheMapAndStaticTracksHaveOneHullForAllTime) {
  const std::vector<Track> tracks{standing_box(1, Box(Vec3(0, 0, 0), Vec3(1, 2, 3)), kOrigin)};
  auto obstacles = obstacles_of(tracks);
  obstacles.push_back({-1, nullptr, Box(Vec3(5, 5, 5), Vec3(6, 6, 6)), {}});
  for (const BodyKind kind : kBodyKinds) {
    const Body body = body_of(kind);
    const SweptObstacles swept(obstacles, body, kOrigin, {0.0, 1.0, 2.0, 900.0}, kEverywhere);
    SeparationCache cache(swept);
    for (int k = 0; k < 3; ++k) {
      ASSERT_EQ(swept.neighbours(k).size(), 2u);
      for (const auto& neighbour : swept.neighbours(k)) {
        const Points& hull = cache.hull(neighbour, {k, k, 4});
        EXPECT_EQ(&hull, &cache.hull(swept.neighbours(0)[static_cast<std::size_t>(neighbour.obstacle)], {0, 0, 1}));
        for (int axis = 0; axis < 3; ++axis) {
          const Vec3 d = Vec3::Unit(axis);
          EXPECT_NEAR(support(hull, d), swept.obstacle(neighbour).box.max()[axis] + support(-body.vertices, d),
                      kRounding);
        }
      }
    }
    EXPECT_EQ(cache.hulls_made(), kind == BodyKind::Polytope ? 2 : 0) << "a box needs no CGAL";
  }
}

TEST(SweptObstacles, AHullDependsOnNothingButItsOwnInputs) {
  Rng rng(5);
  const Case c = random_case(rng);
  const SweptObstacles swept(c.obstacles, c.body, kOrigin, c.times, kEverywhere);
  SeparationCache forward(swept), backward(swept);
  for (int k = swept.intervals() - 1; k >= 0; --k) (void)backward.hull(swept.neighbours(k)[0], {k, 1, 2});
  for (int k = 0; k < swept.intervals(); ++k) {
    EXPECT_EQ(forward.hull(swept.neighbours(k)[0], {k, 1, 2}), backward.hull(swept.neighbours(k)[0], {k, 1, 2}));
  }
}

TEST(SeparationCache, WhatItReturnsStaysWhereItIsUntilItIsStartedAnew) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Rng rng(seed);
    const Case c = random_case(rng);
    const SweptObstacles swept(c.obstacles, c.body, kOrigin, c.times, kEverywhere);
    SeparationCache cache(swept);
    const auto& first = swept.neighbours(0)[0];
    const auto [boxes, direction] = cache.sweep(first, {0});
    const std::vector<CentredBox> kept(boxes.begin(), boxes.end());
    const Points& hull = cache.hull(first, {0});
    const Points kept_hull = hull;
    direction = Vec3(1, 2, 3);
    for (int k = 0; k < swept.intervals(); ++k) {
      for (int part = 0; part < 4; ++part) (void)cache.hull(swept.neighbours(k)[0], {k, part, 4});
    }
    EXPECT_EQ(boxes.data(), cache.sweep(first, {0}).boxes.data());
    EXPECT_TRUE(std::equal(boxes.begin(), boxes.end(), kept.begin(), kept.end(),
                           [](const auto& a, const auto& b) { return a.centre == b.centre && a.half == b.half; }));
    EXPECT_EQ(&hull, &cache.hull(first, {0}));
    EXPECT_EQ(hull, kept_hull);
    EXPECT_EQ(cache.sweep(first, {0}).last_direction, Vec3(1, 2, 3));
    cache.start(swept);
    EXPECT_TRUE(cache.sweep(first, {0}).last_direction.isZero(0.0));
    EXPECT_EQ(cache.hull(first, {0}), kept_hull);
  }
}

TEST(SweptObstacles, AnythingButTwoTimesOrMoreIsRefused) {
  const std::vector<PlanningObstacle> none;
  EXPECT_THROW(SweptObstacles(none, Body{}, kOrigin, {0.0}, kEverywhere), std::invalid_argument);
}

}  // namespace
}  // namespace tern
