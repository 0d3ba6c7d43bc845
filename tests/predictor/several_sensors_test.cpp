// Sensors that see different things at different rates.
#include <gtest/gtest.h>

#include <functional>
#include <utility>

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

}  // namespace
}  // namespace tern
