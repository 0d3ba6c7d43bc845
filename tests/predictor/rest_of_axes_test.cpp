// Tracks that move on one axis of W and rest on others.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "predictor/tracking/tracker.h"
#include "tests/predictor/simulated_motion.h"

namespace tern {
namespace {

using testing::at_seconds;
using testing::Path;

constexpr double kRate = 30.0, kNoise = 0.05;
constexpr int kX = 0, kY = 1, kZ = 2;

/// Swings along y with 3 m and 2 m/s at most. From `leaves_s` on it goes along x as well, at 2 m/s.
Path swinger(double leaves_s = 1e9) {
  return [=](double t) { return Vec3(8.0 + 2.0 * std::max(0.0, t - leaves_s), 3.0 * std::sin(2.0 * t / 3.0), 2.0); };
}

/// Goes around a rectangle. On each side one axis rests, and starts at the corner at once.
struct Patrol {
  Vec3 centre;
  std::array<double, 2> sides;  // m
  double speed;                 // m/s
  double ahead;                 // m along the way at t = 0
  [[nodiscard]] Vec3 at(double t) const {
    const double around = 2.0 * (sides[0] + sides[1]);
    double s = std::fmod(ahead + speed * t, around);
    Vec3 p = centre - Vec3(0.5 * sides[0], 0.5 * sides[1], 0.0);
    for (int side = 0; side < 4; ++side) {
      const auto axis = static_cast<std::size_t>(side % 2);
      const double part = std::min(s, sides[axis]);
      p[side % 2] += side < 2 ? part : -part;
      s -= part;
    }
    return p;
  }
};

/// Feeds one obstacle from `from_s` to `to_s`.
void watch(Tracker& tracker, const Path& path, double from_s, double to_s, Rng& rng) {
  for (int frame = static_cast<int>(std::lround(from_s * kRate)); frame < std::lround(to_s * kRate); ++frame) {
    const double t = frame / kRate;
    tracker.update(testing::observations_at(t, {testing::detection_of(path(t), kNoise, rng)}));
  }
}

/// Returns α at a level, some seconds after the newest detection, m.
Vec3 alpha_after(const Tracker& tracker, double ahead_s, int level) {
  const Track track = tracker.predict(tracker.newest()).at(0);
  return track.alpha_at(track.motion.locate(tracker.newest() + Duration::from_seconds(ahead_s)).index, level);
}

TEST(RestOfAxes, IsNarrowWhereASwingerKeepsToOneAxis) {
  Rng rng(1);
  Tracker tracker(TrackerConfig{});
  watch(tracker, swinger(), 0.0, 5.0, rng);
  const TrackedObject& object = tracker.objects().at(0);
  EXPECT_FALSE(tracker.is_stationary(object));
  EXPECT_TRUE(tracker.is_stationary(object, kX));
  EXPECT_FALSE(tracker.is_stationary(object, kY));
  EXPECT_TRUE(tracker.is_stationary(object, kZ));
  const Vec3 likely = alpha_after(tracker, 1.5, kLevels - 1), full = alpha_after(tracker, 1.5, 0);
  EXPECT_LT(likely[kX], 0.5);
  EXPECT_GT(likely[kY], 1.0);
  EXPECT_LT(likely[kZ], 0.5);
  EXPECT_GT(full[kX], 2.0) << "five seconds of rest say little about one start in a hundred";
}

TEST(RestOfAxes, LosesItsTrustWithAStart) {
  Rng rng(2);
  Tracker tracker(TrackerConfig{});
  watch(tracker, swinger(10.0), 0.0, 10.0, rng);
  const double rested_s = tracker.rest_of_axes()[kX].rested_s;
  EXPECT_NEAR(rested_s, RestRecord{}.rested_s + 10.0 - TrackerConfig{}.resting_after.seconds(), 0.2);
  EXPECT_EQ(tracker.rest_of_axes()[kX].starts, 0);
  watch(tracker, swinger(10.0), 10.0, 11.0, rng);
  EXPECT_EQ(tracker.rest_of_axes()[kX].starts, 1);
  EXPECT_EQ(tracker.rest_of_axes()[kZ].starts, 0);
  EXPECT_FALSE(tracker.is_stationary(tracker.objects().at(0), kX));
  EXPECT_GT(alpha_after(tracker, 1.5, kLevels - 1)[kX], 1.0);
}

/// The hardest kind: one axis rests for one to three seconds, and starts at full speed. At level 0 the models miss 2 %
/// of such corners, with and without rest on axes.
TEST(RestOfAxes, CoversThoseThatTurnCornersAsStated) {
  Rng rng(3);
  std::vector<Patrol> patrols;
  for (int k = 0; k < 8; ++k) {
    patrols.push_back({Vec3(20.0 * k, 0.0, 2.0),
                       {rng.uniform(2.0, 5.0), rng.uniform(2.0, 5.0)},
                       rng.uniform(1.0, 3.0),
                       rng.uniform(0.0, 10.0)});
  }
  Tracker tracker(TrackerConfig{});
  std::array<int, kLevels> covered{};
  int intervals = 0;
  for (int frame = 0; frame < static_cast<int>(30.0 * kRate); ++frame) {
    const double t = frame / kRate;
    std::vector<Detection> seen;
    for (const Patrol& patrol : patrols) seen.push_back(testing::detection_of(patrol.at(t), kNoise, rng));
    tracker.update(testing::observations_at(t, std::move(seen)));
    if (frame % 5 != 0 || t < 2.0) continue;
    for (const Track& track : tracker.predict(tracker.newest())) {
      const double x = track.motion.sample(track.motion.start).p.x();
      const Patrol& truth = patrols.at(static_cast<std::size_t>(std::clamp(std::lround(x / 20.0), 0L, 7L)));
      ++intervals;
      for (int level = 0; level < kLevels; ++level) {
        Track at_level = track;
        for (std::size_t k = 0; k < track.alpha.size(); ++k) at_level.alpha[k] = track.alpha_at(k, level);
        covered[idx(level)] += testing::covers(
                                   at_level, [&](double s) { return truth.at(s); }, 1.0)
                                   ? 1
                                   : 0;
      }
    }
  }
  ASSERT_GT(intervals, 1000);
  for (int level = 1; level < kLevels; ++level) {
    const double stated = kConfidenceLevels[idx(level)];
    EXPECT_GE(testing::wilson(covered[idx(level)], intervals).high, stated)
        << covered[idx(level)] << " of " << intervals;
    RecordProperty("level " + std::to_string(level),
                   std::to_string(static_cast<double>(covered[idx(level)]) / intervals));
  }
}

}  // namespace
}  // namespace tern
