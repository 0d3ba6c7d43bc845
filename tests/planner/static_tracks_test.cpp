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
