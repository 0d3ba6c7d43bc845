#include "planner/look_ahead.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/geometry/box.h"
#include "core/scenario/scenario.h"
#include "core/wire/message_limits.h"
#include "planner/duration.h"
#include "tests/support/planner_worlds.h"
#include "tests/support/random_splines.h"

namespace tern {
namespace {

using namespace support;

constexpr UTime kStart{50'000'000};

TEST(Foresight, HoldsWithinItsTimesForEveryTrackAndRegion) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Rng rng(seed);
    TrackSet set;
    const Box where = box_around(Vec3::Zero(), Vec3(30, 30, 10));
    for (int id = 1; id <= 12; ++id) set.tracks.push_back(random_mover(rng, id, where, kStart, rng.uniform(0.5, 5.0)));
    set.tracks.push_back(standing_box(13, box_around(Vec3::Zero(), Vec3::Ones()), kStart));
    const PredictionProducts products(set);
    const Box region = box_around(random_vector(rng, 10.0), Vec3::Constant(rng.uniform(0.5, 8.0)));
    const Foresight foresight = products.foresight(region);
    EXPECT_LE(foresight.predicted_until, foresight.followed_until);
    std::vector<std::int32_t> found;
    products.index.query(region, found);
    for (std::size_t k = 0; k < set.tracks.size(); ++k) {
      const Track& track = set.tracks[k];
      if (track.kind == TrackKind::Static) continue;
      const UTime last = std::min(foresight.followed_until, track.motion.end() + Duration{100'000'000});
      const Box until = track.bounds(track.motion.start, last - Duration{1});
      if (std::find(found.begin(), found.end(), static_cast<std::int32_t>(k)) == found.end()) {
        EXPECT_FALSE(until.intersects(region)) << "seed " << seed << ", track " << track.id;
      } else {
        EXPECT_TRUE(grown(products.obstacles[k].box, Vec3::Constant(1e-9)).contains(until)) << "seed " << seed;
      }
      // A time at which it may be there although no piece places it there.
      if (foresight.predicted_until <= track.motion.end()) continue;
      const Vec3 p = track.motion.sample(track.motion.end()).p;
      const UTime grows = std::min(foresight.predicted_until, track.motion.end() + Duration{100'000'000}) - Duration{1};
      const Vec3 growth = Vec3::Constant(track.top_speed * (grows - track.motion.end()).seconds());
      EXPECT_FALSE(box_around(p, track.half_extents + track.alpha.back() + growth).intersects(region))
          << "seed " << seed << ", track " << track.id;
    }
  }
}

LookAhead looking(double horizon_s, double followed_s) {
  return {kStart + Duration::from_seconds(followed_s), followed_s, horizon_s};
}

TEST(LocalGoal, FitsIntoTheHorizonWhereAnyDoesAndIsNoNearerThanItMust) {
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    Rng rng(seed);
    const auto draw = [&](double high) {
      return Vec3::Constant(kMinLimit * std::pow(high / kMinLimit, rng.uniform()));
    };
    Limits limits{draw(kMaxSpeedLimit), draw(kMaxAccelerationLimit)};
    if (rng.uniform() < 0.5) limits.j_max = draw(1e6);
    MotionSample start;
    start.p = random_vector(rng, 5.0);
    const std::vector<Vec3> path{start.p, start.p + random_vector(rng, 9.0), start.p + random_vector(rng, 2000.0)};
    const PlannerConfig config;
    const HoldDemand hold;
    const double radius = 0.1 * std::pow(1e4, rng.uniform());
    const LookAhead look = looking(rng.uniform(3.0, 5.0), rng.uniform(7.0, 9.0));
    const LocalGoal aim = local_goal_along(path, start, limits, radius, max_planned_duration(look, hold, config));
    const double room_s = std::min(look.horizon_s - hold.required_s, look.followed_s - hold.cap_s);
    EXPECT_LE(config.duration_scales.front() * aim.planned_s, room_s) << "seed " << seed;
    EXPECT_GT(aim.radius, 0.0);
    EXPECT_LE((aim.goal - start.p).norm(), aim.radius * (1.0 + 1e-9));
    if (aim.radius == radius) continue;
    const LocalGoal farther = local_goal_along(path, start, limits, 1.2001 * aim.radius, 1e9);
    EXPECT_GT(config.duration_scales.front() * farther.planned_s, 0.99 * room_s) << "seed " << seed;
  }
}

TEST(LocalGoal, KeepsIntervalsWithinTheLongestWhereNothingMoves) {
  Limits limits;
  limits.v_max = Vec3::Constant(0.01);
  PlannerConfig config;
  const double longest_s = max_planned_duration(looking(1e9, 1e9), HoldDemand{}, config);
  const LocalGoal aim = local_goal_along({Vec3::Zero(), Vec3(50, 0, 0)}, MotionSample{}, limits, 4.0, longest_s);
  EXPECT_LE(config.duration_scales.front() * aim.planned_s, config.intervals * kMaxIntervalDuration.seconds());
  EXPECT_GT(aim.radius, 2.0);
}

TEST(PlannedDuration, UnderGentleJerkIsNoMoreThanStoppingAndFlyingOn) {
  Limits limits;
  limits.j_max = Vec3::Constant(1e-3);
  MotionSample start;
  const double exact = std::cbrt(32.0);  // (32 d/j)^(1/3)
  EXPECT_LE(planned_duration(start, Vec3(1e-3, 0, 0), limits), exact);
  EXPECT_GE(planned_duration(start, Vec3(1e-3, 0, 0), limits), 0.9 * exact);
  EXPECT_EQ(planned_duration(start, Vec3::Zero(), limits), 0.0);
  limits.j_max = Vec3::Constant(100.0);
  for (const double d : {0.05, 0.3, 4.0, 50.0}) {
    EXPECT_LE(planned_duration(start, Vec3(d, 0, 0), limits), rest_to_rest_s(d, 6.0, 20.0, 100.0) + 1e-9);
    EXPECT_EQ(planned_duration(start, Vec3(d, 0, 0), limits), min_duration(start, Vec3(d, 0, 0), limits));
  }
}

}  // namespace
}  // namespace tern
