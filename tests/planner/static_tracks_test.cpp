#include "planner/static_tracks.h"

#include <gtest/gtest.h>

namespace tern {
namespace {

Track box_at(std::int64_t id, double x) {
  Track track;
  track.id = id;
  track.kind = TrackKind::Static;
  track.half_extents = Vec3::Constant(0.5);
  track.motion.pieces.resize(1);
  track.motion.pieces[0].duration = Duration{1'000'000};
  track.motion.pieces[0].coefficients(0, 3) = x;
  track.alpha.assign(1, Vec3::Zero());
  return track;
}

TrackSet set_of(std::int64_t epoch_us, std::int64_t number, std::vector<Track> tracks) {
  TrackSet set;
  set.header.name = {epoch_us, number};
  set.batch.set = number;
  set.tracks = std::move(tracks);
  return set;
}

TEST(StaticTracks, RemembersWhatLaterSetsLeaveOut) {
  StaticTracks statics;
  EXPECT_TRUE(statics.add(set_of(5, 3, {box_at(1, 1.0), box_at(2, 2.0)})));
  for (const int number : {4, 5}) EXPECT_FALSE(statics.add(set_of(5, number, {box_at(1, 1.0), box_at(2, 2.0)})));
  EXPECT_FALSE(statics.add(set_of(5, 6, {box_at(2, 2.0)})));
  EXPECT_EQ(statics.boxes().size(), 2U);
  EXPECT_EQ(statics.epoch_us(), 5);
  EXPECT_EQ(statics.first_set(), 3);
}

TEST(StaticTracks, AFalseTrackThatCameOnceOrTwiceIsForgotten) {
  StaticTracks statics;
  statics.add(set_of(5, 1, {box_at(1, 1.0), box_at(9, 3.0)}));
  statics.add(set_of(5, 2, {box_at(1, 1.0), box_at(9, 3.0)}));
  EXPECT_TRUE(statics.add(set_of(5, 3, {box_at(1, 1.0)})));
  EXPECT_EQ(statics.boxes().size(), 1U);
}

TEST(StaticTracks, TheMapsMarginFollowsThePoseInSteps) {
  StaticTracks statics;
  auto add = [&, number = 0](double margin) mutable {
    TrackSet set = set_of(5, ++number, {});
    if (margin > 0.0) set.pose_error.emplace().apart = margin;
    return statics.add(set);
  };
  const std::uint64_t without = statics.digest();
  EXPECT_FALSE(add(0.0));
  EXPECT_TRUE(add(0.32));
  EXPECT_NEAR(statics.obstacles().map_margin, 0.4, 1e-12);
  EXPECT_NE(statics.digest(), without);
  for (const double margin : {0.4, 0.35, 0.2}) EXPECT_FALSE(add(margin)) << margin;
  EXPECT_TRUE(add(0.5));
  EXPECT_TRUE(add(0.15));
  EXPECT_NEAR(statics.obstacles().map_margin, 0.2, 1e-12);
  EXPECT_TRUE(add(0.0));
  EXPECT_EQ(statics.digest(), without);
}

/// A set at `at_s` with one estimated track of this width along y, which moves at this speed along x.
TrackSet estimated(double at_s, double width, double x = 8.0, double speed = 0.0) {
  Track track = box_at(4, x);
  track.kind = TrackKind::Estimated;
  track.half_extents = Vec3(0.3, 0.5 * width, 1.5);
  track.motion.start = UTime{0} + Duration::from_seconds(at_s);
  track.motion.pieces[0].coefficients(0, 2) = speed;
  track.alpha.assign(1, Vec3::Constant(0.1));
  TrackSet set = set_of(5, static_cast<std::int64_t>(1.0 + 20.0 * at_s), {track});
  set.made_at = track.motion.start;
  return set;
}

/// Adds sets of a track over [from_s, to_s) at 20 Hz.
void watch(StaticTracks& statics, double from_s, double to_s, double width, double x = 8.0, double speed = 0.0) {
  for (int k = 0; from_s + 0.05 * k < to_s - 1e-9; ++k) statics.add(estimated(from_s + 0.05 * k, width, x, speed));
}

TEST(StaticTracks, AWideTrackThatHasRestedIsAnObstacleOfThePath) {
  StaticTracks statics;
  watch(statics, 1.0, 2.9, 6.0);
  EXPECT_TRUE(statics.obstacles().resting.empty());
  EXPECT_EQ(statics.digest(), StaticTracks().digest());
  watch(statics, 2.9, 3.2, 6.0);
  ASSERT_EQ(statics.obstacles().resting.size(), 1U);
  EXPECT_TRUE(statics.obstacles().resting[0].contains(Box(Vec3(7.6, -3.1, -1.6), Vec3(8.4, 3.1, 1.6))));
  EXPECT_TRUE(statics.boxes().empty()) << "it may move";
  const std::uint64_t digest = statics.digest();
  watch(statics, 3.2, 5.0, 6.05);
  EXPECT_EQ(statics.digest(), digest) << "noise changes no path";
}

TEST(StaticTracks, AWallThatComesIntoViewStepByStepRests) {
  StaticTracks statics;
  for (int k = 0; k < 100; ++k) {
    const double width = 6.0 + 0.1 * k;  // its lower face stays, its centre moves at 1 m/s
    TrackSet set = estimated(1.0 + 0.05 * k, width);
    set.tracks[0].motion.pieces[0].coefficients(1, 3) = 0.5 * width;
    statics.add(set);
    ASSERT_EQ(statics.obstacles().resting.size(), k < 40 ? 0U : 1U) << k;
  }
  EXPECT_GE(statics.obstacles().resting[0].max().y(), 15.0);
}

TEST(StaticTracks, ARestingTrackThatBeginsToMoveLeavesThePath) {
  StaticTracks statics;
  watch(statics, 1.0, 4.0, 6.0);
  ASSERT_EQ(statics.obstacles().resting.size(), 1U);
  EXPECT_TRUE(statics.add(estimated(4.0, 6.0, 8.1, 0.5)));
  EXPECT_TRUE(statics.obstacles().resting.empty());
  EXPECT_EQ(statics.digest(), StaticTracks().digest());
  watch(statics, 4.05, 5.0, 6.0, 9.0);
  EXPECT_TRUE(statics.obstacles().resting.empty()) << "it has to rest anew";
}

TEST(StaticTracks, ANarrowRestingTrackIsLeftToTheSearch) {
  StaticTracks statics;
  watch(statics, 1.0, 5.0, 4.0);
  EXPECT_TRUE(statics.obstacles().resting.empty());
}

TEST(StaticTracks, TheBoxOfAWallThatGoesOutOfSightDoesNotGrow) {
  StaticTracks statics;
  watch(statics, 1.0, 4.0, 6.0);
  const Box seen = statics.obstacles().resting.at(0);
  for (int k = 0; k < 20; ++k) {
    TrackSet set = estimated(4.0 + 0.05 * k, 6.0);
    set.tracks[0].alpha[0] += Vec3::Constant(0.1 * k);
    statics.add(set);
  }
  EXPECT_EQ(statics.obstacles().resting.at(0).max(), seen.max());
}

/// A set of three walls that touch, the last one 1.3 m wide, and a post apart from them.
TrackSet dead_end(double at_s, double gap = 0.0) {
  TrackSet set = estimated(at_s, 1.3);
  const auto add = [&](std::int64_t id, const Vec3& p, const Vec3& half) {
    Track track = set.tracks[0];
    track.id = id;
    track.half_extents = half;
    track.motion.pieces[0].coefficients.col(3) = p;
    set.tracks.push_back(track);
  };
  add(5, Vec3(5.2, 1.0, 0), Vec3(2.6, 0.1, 1.5));
  add(6, Vec3(5.2, -1.0 - gap, 0), Vec3(2.0, 0.1, 1.5));
  add(7, Vec3(5.2, 4.0, 0), Vec3(0.4, 0.4, 1.5));
  return set;
}

TEST(StaticTracks, NarrowTracksThatTouchAWideOneCloseItsPocket) {
  StaticTracks statics;
  for (int k = 0; k < 50; ++k) statics.add(dead_end(1.0 + 0.05 * k));
  EXPECT_EQ(statics.obstacles().resting.size(), 3U) << "the post is left to the search";
  StaticTracks apart;
  for (int k = 0; k < 50; ++k) apart.add(dead_end(1.0 + 0.05 * k, 1.5));
  EXPECT_EQ(apart.obstacles().resting.size(), 2U) << "the third wall is 4 m wide and touches none";
}

TEST(StaticTracks, ARestingTrackThatSetsOmitIsForgottenAfterAWhile) {
  StaticTracks statics;
  watch(statics, 1.0, 4.0, 6.0);
  TrackSet without = estimated(6.0, 6.0);
  without.tracks.clear();
  EXPECT_FALSE(statics.add(without));
  without.made_at = without.made_at + StaticTracks::kOmittedFor;
  EXPECT_TRUE(statics.add(without));
  EXPECT_TRUE(statics.obstacles().resting.empty());
}

TEST(StaticTracks, TakesTheNewestBoxOfATrack) {
  StaticTracks statics;
  statics.add(set_of(5, 1, {box_at(1, 1.0)}));
  const std::uint64_t before = statics.digest();
  EXPECT_TRUE(statics.add(set_of(5, 2, {box_at(1, 1.5)})));
  EXPECT_EQ(statics.boxes()[0].center().x(), 1.5);
  EXPECT_NE(statics.digest(), before);
}

TEST(StaticTracks, AnotherPredictorStartsANewMemory) {
  StaticTracks statics;
  statics.add(set_of(5, 1, {box_at(1, 1.0)}));
  EXPECT_TRUE(statics.add(set_of(6, 9, {})));
  EXPECT_TRUE(statics.boxes().empty());
  EXPECT_EQ(statics.digest(), StaticTracks().digest());
  EXPECT_EQ(statics.first_set(), 9);
}

TEST(StaticTracks, TheOrderOfFirstSightDoesNotMatter) {
  StaticTracks one, other;
  one.add(set_of(5, 1, {box_at(1, 1.0)}));
  one.add(set_of(5, 2, {box_at(1, 1.0), box_at(2, 2.0)}));
  other.add(set_of(5, 1, {box_at(2, 2.0)}));
  other.add(set_of(5, 2, {box_at(1, 1.0), box_at(2, 2.0)}));
  EXPECT_EQ(one.digest(), other.digest());
}

}  // namespace
}  // namespace tern
