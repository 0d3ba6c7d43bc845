// Sensors that see different things at different rates.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "predictor/tracking/track_bound.h"
#include "predictor/tracking/tracker.h"
#include "tests/predictor/simulated_motion.h"

namespace tern {
namespace {

using testing::detection_of;
using testing::observations_at;

constexpr double kRate = 30.0;

ObservationSet frame(std::int32_t sensor, double t, std::vector<Detection> detections) {
  ObservationSet set = observations_at(t, std::move(detections));
  set.sensor_id = sensor;
  return set;
}

constexpr std::int32_t kLidar = 1, kCamera = 2;
// A lidar at 10 Hz and a camera at 30 Hz over [from, to); `see` returns the detections of a frame.
void watch(Tracker& tracker, double from, double to,
           const std::function<std::vector<Detection>(std::int32_t, double)>& see) {
  for (int k = 0; from + k / 30.0 < to; ++k) {
    const double t = from + k / 30.0;
    if (k % 3 == 0) tracker.update(frame(kLidar, t, see(kLidar, t)));
    tracker.update(frame(kCamera, t + 0.01, see(kCamera, t + 0.01)));
  }
}

// The tracks of a stationary obstacle that only one sensor sees.
std::function<std::vector<Detection>(std::int32_t, double)> seen_only_by(std::int32_t sensor, Rng& rng) {
  return [sensor, &rng](std::int32_t asked, double) {
    return asked == sensor ? std::vector{detection_of(Vec3::Zero(), 0.01, rng)} : std::vector<Detection>{};
  };
}

std::vector<Detection> nothing(std::int32_t, double) { return {}; }

TEST(TrackerOfTwoSensors, PublishesATrackThatOnlyTheSlowerOneSees) {
  Rng rng(10);
  Tracker tracker(TrackerConfig{});
  watch(tracker, 0.0, 0.25, seen_only_by(kLidar, rng));
  ASSERT_EQ(tracker.predict(tracker.newest()).size(), 1u);
  EXPECT_EQ(tracker.objects().size(), 1u);
  EXPECT_EQ(tracker.objects().front().id, kFirstOwnTrackId);
}

TEST(TrackerOfTwoSensors, CountsTheDetectionsOfBoth) {
  Rng rng(11);
  Tracker tracker(TrackerConfig{});
  watch(tracker, 0.0, 0.05, [&](std::int32_t, double) { return std::vector{detection_of(Vec3::Zero(), 0.01, rng)}; });
  EXPECT_EQ(tracker.predict(tracker.newest()).size(), 1u);
}

TEST(TrackerOfTwoSensors, ForgetsAFalseAlarmOfASensorThatFellSilent) {
  Rng rng(12);
  Tracker tracker(TrackerConfig{});
  tracker.update(frame(kLidar, 0.0, {detection_of(Vec3::Zero(), 0.01, rng)}));
  for (int k = 1; k <= 60; ++k) tracker.update(frame(kCamera, k / kRate, {}));
  EXPECT_TRUE(tracker.objects().empty());
}

TEST(TrackerOfTwoSensors, OnlyTheSensorThatDetectedATrackCanMissIt) {
  for (const bool lidar_lives : {true, false}) {
    Rng rng(13);
    Tracker tracker(TrackerConfig{});
    watch(tracker, 0.0, 2.0, seen_only_by(kLidar, rng));
    double alpha = 0.0;
    for (double t = 2.0; t < 6.0; t += 1.0) {
      if (lidar_lives) {
        watch(tracker, t, t + 1.0, nothing);
        continue;
      }
      for (int k = 0; k < 30; ++k) tracker.update(frame(kCamera, t + k / kRate, {}));
      const std::vector<Track> tracks = tracker.predict(tracker.newest());
      ASSERT_EQ(tracks.size(), 1u) << t;
      EXPECT_GT(tracks[0].alpha.back().x(), alpha);
      alpha = tracks[0].alpha.back().x();
    }
    EXPECT_EQ(tracker.predict(tracker.newest()).size(), lidar_lives ? 0u : 1u);
    tracker.update(frame(kCamera, 32.1, {}));
    EXPECT_TRUE(tracker.objects().empty());
  }
}

TEST(TrackerOfTwoSensors, TheRangeIsThatOfTheSensorThatDetectedTheTrack) {
  Rng rng(14);
  Tracker tracker(TrackerConfig{});
  watch(tracker, 0.0, 2.0, seen_only_by(kLidar, rng));
  for (int k = 0; k < 100; ++k) {
    ObservationSet gone_by = frame(kLidar, 2.0 + k / 10.0, {});
    gone_by.range_m = 8.0;
    gone_by.sensor_position = Vec3(10.0, 0.0, 0.0);
    tracker.update(gone_by);
    tracker.update(frame(kCamera, 2.01 + k / 10.0, {}));  // unlimited range, and never detected it
  }
  EXPECT_EQ(tracker.objects().size(), 1u);
}

/// At this rate, detections within the span of a smoothed position are of two instants.
TEST(TrackerOfTwoSensors, ThatMeasureAtTheSameTimesPredictWhereAnObstacleWillBe) {
  const auto error_after = [](const std::vector<std::int32_t>& sensors) {
    Rng rng(15);
    Tracker tracker(TrackerConfig{});
    constexpr double kPeriod = 0.2;
    double largest = 0.0;
    for (double t = 0.0; t < 12.0; t += kPeriod) {
      for (const std::int32_t sensor : sensors) {
        tracker.update(frame(sensor, t, {detection_of(Vec3(t, 0.0, 1.0), 0.02, rng)}));
      }
      if (t < 8.0) continue;
      const std::vector<Track> tracks = tracker.predict(tracker.newest());
      if (tracks.size() != 1) return std::numeric_limits<double>::infinity();
      const Vec3 apart = tracks[0].motion.sample(tracker.newest() + Duration{1'000'000}).p - Vec3(t + 1.0, 0.0, 1.0);
      if (!apart.allFinite()) return std::numeric_limits<double>::infinity();
      largest = std::max(largest, apart.norm());
    }
    return largest;
  };
  EXPECT_LT(error_after({kLidar}), 0.5);
  EXPECT_LT(error_after({kLidar, kCamera}), 0.5);
}

/// A set out of order has all later ones used again.
TEST(TrackerOfTwoSensors, ASetOutOfOrderIsUsedUnlessItCostsTooMuch) {
  for (const bool is_costly : {false, true}) {
    Rng rng(16);
    Tracker tracker(TrackerConfig{});
    std::vector<Detection> detections;
    for (int k = 0; k < 600; ++k) detections.push_back(detection_of(Vec3(5.0 * k, 0.0, 1.0), 0.01, rng));
    const int later = is_costly ? 20 : 10;
    for (int k = 0; k <= later; ++k) tracker.update(frame(kCamera, 0.01 * k, detections));
    const UpdateOutcome outcome = tracker.update(frame(kLidar, 0.005, {}));
    EXPECT_EQ(outcome, is_costly ? UpdateOutcome::TooCostly : UpdateOutcome::Used);
    EXPECT_EQ(tracker.update(frame(kLidar, 0.01 * later, detections)), UpdateOutcome::Used) << "in order";
  }
}

/// A wall's anchor may be far away while its face is near.
TEST(TrackBound, KeepsTheTracksWithTheNearestBoxes) {
  std::vector<TrackedObject> objects(3);
  objects[0].position = Vec3(30.0, 2.5, 0.0);
  objects[0].half_extents = Vec3(30.0, 0.5, 2.0);
  objects[1].position = Vec3(0.0, 5.0, 0.0);
  objects[2].position = Vec3(0.0, 4.0, 0.0);
  for (std::size_t k = 0; k < objects.size(); ++k) objects[k].id = static_cast<std::int64_t>(k);
  EXPECT_EQ(bound_tracks(objects, 0, kFirstOwnTrackId, 2, Vec3::Zero(), UTime{1}), 0);
  ASSERT_EQ(objects.size(), 2u);
  EXPECT_EQ(objects[0].id, 0);
  EXPECT_EQ(objects[1].id, 2);
}

}  // namespace
}  // namespace tern
