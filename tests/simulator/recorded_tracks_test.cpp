#include "simulator/worlds/recorded_tracks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tern {
namespace {

using ::testing::HasSubstr;

RecordedTracksSpec five_columns() {
  RecordedTracksSpec spec;
  spec.file = "people.txt";
  spec.frames_per_second = 10.0;
  spec.metres_per_unit = 0.01;
  return spec;
}

std::string error_of(const std::string& text, const RecordedTracksSpec& spec = five_columns()) {
  const auto tracks = parse_recorded_tracks(text, "people.txt", spec);
  return tracks ? "accepted" : tracks.error().message;
}

TEST(RecordedTracks, ConvertUnitsAndFramesAndSortByPerson) {
  const auto tracks = parse_recorded_tracks(
      "# id frame x y z\n7 10 100 -200 170\n\n2 10 0 0 180\r\n 7\t12 +150 -2e2 170", "people.txt", five_columns());
  ASSERT_TRUE(tracks) << tracks.error().message;
  ASSERT_EQ(tracks->size(), 2u);
  EXPECT_EQ((*tracks)[0].id, 2);
  const RecordedTrack& seven = (*tracks)[1];
  ASSERT_EQ(seven.points.size(), 2u);
  EXPECT_DOUBLE_EQ(seven.points[1].first, 1.2);
  EXPECT_LT((seven.points[1].second - Vec3(1.5, -2, 1)).norm(), 1e-15);
}

TEST(RecordedTracks, ReadHeightWhereAColumnHoldsIt) {
  RecordedTracksSpec spec = five_columns();
  spec.z_column = 4;
  const auto tracks = parse_recorded_tracks("1 1 0 0 150\n", "people.txt", spec);
  EXPECT_DOUBLE_EQ(tracks->at(0).points[0].second.z(), 1.5);
}

TEST(RecordedTracks, NameFileLineValueAndLimitOfWhatIsWrong) {
  EXPECT_EQ(error_of("1 1 0 0 0\n1 2 0 0\n"), "people.txt:2: 4 columns, 5 expected");
  EXPECT_EQ(error_of("1 1 0 0 0 0 0\n"), "people.txt:1: 6 columns or more, 5 expected");
  EXPECT_EQ(error_of("1 1 0 abc 0\n"), "people.txt:1: 'abc' is not a finite number");
  EXPECT_EQ(error_of("1 1 0 1.5m 0\n"), "people.txt:1: '1.5m' is not a finite number");
  EXPECT_EQ(error_of("1 1 nan 0 0\n"), "people.txt:1: 'nan' is not a finite number");
  EXPECT_EQ(error_of("1 1 1e999 0 0\n"), "people.txt:1: '1e999' is not a finite number");
  EXPECT_EQ(error_of("1.5 1 0 0 0\n"), "people.txt:1: id 1.5 is not a whole number");
  EXPECT_EQ(error_of("1 5 0 0 0\n2 1 0 0 0\n1 4 0 0 0\n"),
            "people.txt:3: id 1: frame 4 after frame 5, frames must ascend");
  EXPECT_THAT(error_of("1 5 0 0 0\n1 5 0 0 0\n"), HasSubstr("frames must ascend"));
  EXPECT_THAT(error_of("1 1 1e8 0 0\n"), HasSubstr("people.txt:1: position (1000000, 0, 1) m, beyond 100000 m"));
  EXPECT_THAT(error_of("1 1e9 0 0 0\n"), HasSubstr("beyond 100000 s"));
  EXPECT_EQ(error_of("# nobody\n"), "people.txt: no rows");
}

TEST(RecordedTracks, RefuseASpecThatMakesNoSense) {
  RecordedTracksSpec spec = five_columns();
  spec.x_column = 5;
  EXPECT_THAT(error_of("1 1 0 0 0\n", spec), HasSubstr("column 5 of 5"));
  spec = five_columns();
  spec.columns = 65;
  EXPECT_THAT(error_of("", spec), HasSubstr("columns 65, not in [1, 64]"));
  spec = five_columns();
  spec.frames_per_second = 0.0;
  EXPECT_THAT(error_of("", spec), HasSubstr("frames_per_second 0"));
  spec = five_columns();
  spec.metres_per_unit = -1.0;
  EXPECT_THAT(error_of("", spec), HasSubstr("metres_per_unit -1"));
}

TEST(RecordedTracks, OfAMissingFileAreAnError) {
  EXPECT_FALSE(load_recorded_tracks("/nonexistent/people.txt", five_columns()));
  EXPECT_FALSE(load_recorded_tracks("/", five_columns()));
}

/// A person walks along x through the origin, 1 m/s, there at 10 s; recorded each second from 0 to 20 s.
std::vector<RecordedTrack> walker() {
  RecordedTrack track{1, {}};
  for (int k = 0; k <= 20; ++k) track.points.emplace_back(k, Vec3(k - 10.0, 0, 1));
  return {track};
}

TEST(RecordedStart, IsTheFirstFrameThatLeavesTheStartClearForASecond) {
  RecordedTracksSpec spec = five_columns();
  const Vec3 start(0, 0, 1);
  // Within 1 m between 9 and 11 s; 10 frames a second.
  const auto from = [&](double start_s) {
    spec.start_s = start_s;
    return recorded_start(walker(), spec, start).value();
  };
  EXPECT_EQ(from(0.0), 0.0);
  EXPECT_EQ(from(6.53), 6.6) << "a whole frame, though only every tenth is recorded";
  EXPECT_EQ(from(7.9), 7.9);
  EXPECT_EQ(from(8.05), 11.0) << "at 9 s, 0.9 s after frame 81, the walker is near";
  EXPECT_EQ(from(10.0), 11.0);
  spec.wait_for_clear_start = false;
  EXPECT_EQ(from(9.3), 9.3);
}

TEST(RecordedStart, BeyondTheLastFrameIsAnError) {
  RecordedTracksSpec spec = five_columns();
  spec.start_s = 21.0;
  EXPECT_THAT(recorded_start(walker(), spec, Vec3::Zero()).error().message, HasSubstr("from 21 s to the last at 20 s"));
}

TEST(RecordedObstacles, LeaveOutWhoHasGoneAndKeepWholeMicroseconds) {
  RecordedTracksSpec spec = five_columns();
  EXPECT_TRUE(recorded_obstacles(walker(), spec, 20.0).empty());
  const auto obstacles = recorded_obstacles(walker(), spec, 1.0 / 3.0);
  ASSERT_EQ(obstacles.size(), 1u);
  EXPECT_EQ(obstacles[0].name, "people#1");
  const auto& motion = std::get<WaypointMotion>(obstacles[0].motion);
  EXPECT_TRUE(motion.vanish);
  EXPECT_DOUBLE_EQ(motion.points[1].first, 0.666667);
}

}  // namespace
}  // namespace tern
