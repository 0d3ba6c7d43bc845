#include "simulator/worlds/recorded_tracks.h"

#include <fmt/format.h>
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

RecordedFile parsed(const std::string& text, const RecordedTracksSpec& spec = five_columns()) {
  auto file = parse_recorded_tracks(text, "people.txt", spec);
  EXPECT_TRUE(file) << file.error().message;
  return file ? std::move(*file) : RecordedFile{};
}

TEST(RecordedTracks, ConvertUnitsAndFramesAndSortByPerson) {
  const RecordedFile file = parsed("# id frame x y z\n7 10 100 -200 170\n\n2 10 0 0 180\r\n 7\t12 +150 -2e2 170");
  ASSERT_EQ(file.tracks.size(), 2u);
  EXPECT_EQ(file.tracks[0].id, 2);
  const RecordedTrack& seven = file.tracks[1];
  ASSERT_EQ(seven.points.size(), 2u);
  EXPECT_DOUBLE_EQ(seven.points[1].first, 1.2);
  EXPECT_LT((seven.points[1].second - Vec3(1.5, -2, 1)).norm(), 1e-15);
  EXPECT_TRUE(file.remarks.empty());
}

TEST(RecordedTracks, ReadHeightWhereAColumnHoldsIt) {
  RecordedTracksSpec spec = five_columns();
  spec.z_column = 4;
  EXPECT_DOUBLE_EQ(parsed("1 1 0 0 150\n", spec).tracks.at(0).points[0].second.z(), 1.5);
}

TEST(RecordedTracks, NameFileLineValueAndLimitOfWhatIsWrong) {
  EXPECT_EQ(error_of("1 1 0 0 0\n1 2 0 0\n"), "people.txt:2: 4 columns, 5 expected");
  EXPECT_EQ(error_of("1 1 0 0 0 0 0\n"), "people.txt:1: 6 columns or more, 5 expected");
  EXPECT_EQ(error_of("1 1 0 abc 0\n"), "people.txt:1: 'abc' is not a number");
  EXPECT_EQ(error_of("1 1 0 1.5m 0\n"), "people.txt:1: '1.5m' is not a number");
  EXPECT_EQ(error_of("1.5 1 0 0 0\n"), "people.txt:1: id 1.5 is not a whole number");
  EXPECT_THAT(error_of("1 1 1e8 0 0\n"), HasSubstr("people.txt:1: position (1000000, 0, 1) m, beyond 100000 m"));
  EXPECT_EQ(error_of("# nobody\n"), "people.txt: no rows");
  EXPECT_EQ(error_of("1 1 nan 0 0\n1 2 1e999 0 0\n"), "people.txt: no rows: 2 lack a finite number");
  EXPECT_EQ(error_of("id frame x y z\nid frame x y z\n"), "people.txt:2: 'frame' is not a number");
}

/// TUM format: time, position, attitude.
RecordedTracksSpec tum(double per_second) {
  RecordedTracksSpec spec;
  spec.columns = 8;
  spec.id_column = -1;
  spec.frame_column = 0;
  spec.x_column = 1;
  spec.y_column = 2;
  spec.z_column = 3;
  spec.frames_per_second = per_second;
  return spec;
}

TEST(RecordedTracks, OfUnixTimesCountFromTheFirstOne) {
  const std::string rest = " 6 2 1.5 0 0 0 1\n";
  const RecordedFile seconds = parsed("# timestamp tx ty tz qx qy qz qw\n1403636579.763555" + rest +
                                          "1403636579.783555" + rest + "1403636580.763555" + rest,
                                      tum(1.0));
  ASSERT_EQ(seconds.tracks.at(0).points.size(), 3u);
  EXPECT_EQ(seconds.tracks[0].points[0].first, 0.0);
  EXPECT_NEAR(seconds.tracks[0].points[1].first, 0.02, 1e-6);
  EXPECT_NEAR(seconds.tracks[0].points[2].first, 1.0, 1e-6);
  EXPECT_THAT(seconds.remarks,
              testing::ElementsAre("people.txt: its times count from the first one, 1403636579.76356"));
  const RecordedFile nanoseconds = parsed(
      "#timestamp [ns],p_x [m],p_y [m],p_z [m],q_w,q_x,q_y,q_z\r\n1403636580838555648,4,-1.7,0.7,1,0,0,0\r\n"
      "1403636580843555648, 4.1, -1.7, 0.7, 1, 0, 0, 0\r\n",
      tum(1e9));
  EXPECT_NEAR(nanoseconds.tracks.at(0).points.at(1).first, 0.005, 1e-6);
  EXPECT_LT((nanoseconds.tracks[0].points[1].second - Vec3(4.1, -1.7, 0.7)).norm(), 1e-12);
  EXPECT_THAT(error_of("1403636580838555648" + rest + "1403636590838555648" + rest, tum(1.0)),
              testing::AllOf(HasSubstr("people.txt:2: frame 1.40363659083856e+18 is 1e+10 s after the first"),
                             HasSubstr("1e9 for nanoseconds")));
}

TEST(RecordedTracks, MayHaveCommasAHeaderAMarkAndTextInOtherColumns) {
  for (const char* text : {"\xEF\xBB\xBFid,frame,x,y,kind\n1,10,100,200,person\n1,20,150,200,person\n",
                           "id;frame;x;y;kind\r\n1;10;100;200;person\r\n1;20;150;200;person\r\n",
                           "id\tframe\tx\ty\tkind\n1\t10\t100\t200\tperson\n1\t20\t150\t200\tperson\n",
                           "1 , 10, 100 ,200 , a b\n1,20,150,200,\"c\"\n"}) {
    const RecordedFile file = parsed(text);
    ASSERT_EQ(file.tracks.size(), 1u) << text;
    ASSERT_EQ(file.tracks[0].points.size(), 2u) << text;
    EXPECT_LT((file.tracks[0].points[1].second - Vec3(1.5, 2, 1)).norm(), 1e-12);
    EXPECT_TRUE(file.remarks.empty());
  }
}

TEST(RecordedTracks, MayHaveIdsThatAreText) {
  const RecordedFile file = parsed("Drone B,10,100,200,x\n7,10,0,0,x\nDrone A,10,1,1,x\nDrone B,20,150,200,x\n");
  ASSERT_EQ(file.tracks.size(), 3U);
  EXPECT_EQ(file.tracks[0].name, "7");
  EXPECT_EQ(file.tracks[1].name, "Drone B");
  EXPECT_EQ(file.tracks[1].points.size(), 2U);
  EXPECT_EQ(file.tracks[2].name, "Drone A");
}

TEST(RecordedTracks, LeaveOutAndCountRowsWithoutANumberAndRowsOfATimeThatIsTaken) {
  const RecordedFile file = parsed("1,10,0,0,0\n1,11,nan,0,0\n1,12,,0,0\n1,13,1e999,0,0\n1,14,1,0,nan\n1,14,9,9,0\n");
  ASSERT_EQ(file.tracks.at(0).points.size(), 2u);
  EXPECT_EQ(file.tracks[0].points[1].second.x(), 0.01) << "the first of two rows";
  EXPECT_THAT(file.remarks, testing::ElementsAre(HasSubstr("3 of 6 rows are left out: a number is missing"),
                                                 HasSubstr("1 of 6 rows are left out: their track has")));
}

TEST(RecordedTracks, AreSortedByTime) {
  const RecordedFile file = parsed("1 5 50 0 0\n2 1 0 0 0\n1 4 40 0 0\n1 6 60 0 0\n");
  ASSERT_EQ(file.tracks.at(0).points.size(), 3u);
  EXPECT_DOUBLE_EQ(file.tracks[0].points[0].first, 0.4);
  EXPECT_DOUBLE_EQ(file.tracks[0].points[2].second.x(), 0.6);
  EXPECT_THAT(file.remarks, testing::ElementsAre(HasSubstr("the rows of 1 tracks were not in the order of time")));
}

/// Rows of one id that walks at 1 m/s: 10 positions a second from `from_s` on, from x0.
std::string walk(double from_s, int rows, double x0) {
  std::string text;
  for (int k = 0; k < rows; ++k) text += fmt::format("1 {} {} 200 0\n", 10.0 * from_s + k, 100.0 * x0 + 10.0 * k);
  return text;
}

TEST(RecordedTracks, AreCutWhereAnIdIsReusedLater) {
  const RecordedFile file = parsed(walk(0, 30, 2) + walk(23, 30, 35) + walk(60, 1, 0));
  ASSERT_EQ(file.tracks.size(), 2u);
  EXPECT_DOUBLE_EQ(file.tracks[0].points.back().first, 2.9);
  EXPECT_DOUBLE_EQ(file.tracks[1].points.front().first, 23.0);
  EXPECT_THAT(file.remarks, testing::ElementsAre(HasSubstr("tracks are cut at 2 gaps"),
                                                 HasSubstr("1 positions are left out: they stand alone")));
  const auto obstacles = recorded_obstacles(file.tracks, five_columns(), 0.0);
  ASSERT_EQ(obstacles.size(), 2u);
  EXPECT_EQ(obstacles[1].name, "people#1.2");
  EXPECT_EQ(parsed("1 0 0 0 0\n1 100 5 0 0\n1 200 9 0 0\n").tracks.size(), 1u) << "a slow recording has no gap";
}

TEST(RecordedTracks, SayWhereAStepIsNoMotion) {
  const RecordedFile file = parsed(walk(0, 30, 2) + walk(3, 30, 10));
  ASSERT_EQ(file.tracks.size(), 1u);
  EXPECT_THAT(file.remarks, testing::ElementsAre(testing::AllOf(HasSubstr("1 steps are faster than 50 m/s, or"),
                                                                HasSubstr("51 m/s, in track 1"))));
  std::string two;
  for (int k = 0; k < 20; ++k) two += fmt::format("1 {} {} 0 0\n1 {} 3000 0 0\n", k, 10 * k, k + 0.5);
  EXPECT_THAT(parsed(two).remarks, testing::ElementsAre(HasSubstr("39 steps are faster than 50 m/s")));
}

TEST(RecordedTracks, RefuseASpecThatMakesNoSense) {
  RecordedTracksSpec spec = five_columns();
  spec.x_column = 5;
  EXPECT_THAT(error_of("1 1 0 0 0\n", spec), HasSubstr("column 5 of 5"));
  spec = five_columns();
  spec.columns = 101;
  EXPECT_THAT(error_of("", spec), HasSubstr("columns 101, not in [1, 100]"));
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
  RecordedTrack track;
  track.name = "1";
  for (int k = 0; k <= 20; ++k) track.points.emplace_back(k, Vec3(k - 10.0, 0, 1));
  return {track};
}

TEST(RecordedStart, IsTheFirstFrameThatLeavesTheStartClearForASecond) {
  RecordedTracksSpec spec = five_columns();
  const Vec3 start(0, 0, 1);
  // The walker is within 1 m of the start from 9 to 11 s. The file has 10 frames per second.
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
