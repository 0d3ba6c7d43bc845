// The speed of a scene, by the speeds of its tracks.
#include "predictor/tracking/speed_record.h"

#include <gtest/gtest.h>

namespace tern {
namespace {

SpeedRecord of_walkers(std::size_t count) {
  SpeedRecord record;
  for (std::size_t k = 0; k < count; ++k) record.add(Vec3(1.2, 0.9, 0.0), static_cast<std::int64_t>(k));
  return record;
}

TEST(SpeedRecord, IsSlowOnceEnoughTracksWereSeenToMove) {
  EXPECT_EQ(of_walkers(kMinMovers - 1).scene_speed(), SceneSpeed::Any);
  EXPECT_EQ(of_walkers(kMinMovers).scene_speed(), SceneSpeed::Slow);
}

TEST(SpeedRecord, CountsATrackOnceAndNoneThatRests) {
  SpeedRecord record = of_walkers(kMinMovers - 1);
  record.add(Vec3(1.2, 0.9, 0.0), 0);
  record.add(Vec3(0.1, 0.0, 0.0), 100);
  EXPECT_EQ(record.scene_speed(), SceneSpeed::Any);
}

TEST(SpeedRecord, IsNeverSlowAfterOneFastTrack) {
  SpeedRecord record = of_walkers(kMinMovers);
  record.add(Vec3(2.0, -2.0, 0.0), 100);
  EXPECT_EQ(record.scene_speed(), SceneSpeed::Any);
  EXPECT_EQ(record.max_axis_speed(), 2.0);
}

}  // namespace
}  // namespace tern
