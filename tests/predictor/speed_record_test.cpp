// The speed of a scene, by the speeds of its tracks.
#include "predictor/tracking/speed_record.h"

#include <gtest/gtest.h>

#include <optional>

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

TEST(SpeedRecord, AJumpToANeighbourIsNoSpeed) {
  const auto at = [](double s) { return UTime{} + Duration::from_seconds(s); };
  SpeedRecord record = of_walkers(kMinMovers);
  std::optional<TrackSpeed> last;
  record.add_sighted({at(0.0), Vec3(1, 0, 0)}, 7, last);
  for (const double s : {0.25, 0.5}) record.add_sighted({at(s), Vec3(6, 0, 0)}, 7, last);  // two spans share the jump
  for (const double s : {0.75, 1.0}) record.add_sighted({at(s), Vec3(1, 0, 0)}, 7, last);
  EXPECT_EQ(record.scene_speed(), SceneSpeed::Slow);
  record.add_sighted({at(1.5), Vec3(-5, 0, 0)}, 7, last);
  record.add_sighted({at(2.0), Vec3(4, 0, 0)}, 7, last);
  EXPECT_EQ(record.scene_speed(), SceneSpeed::Any) << "it was fast for a second";
  EXPECT_EQ(record.max_axis_speed(), 4.0);
}

}  // namespace
}  // namespace tern
