#include "predictor/models/declared.h"

#include <gtest/gtest.h>

#include <cstring>

#include "tests/predictor/simulated_motion.h"

namespace tern {
namespace {

using testing::at_seconds;

// Ten pieces of half a second from t = 10 s, random coefficients and α.
Track random_track(Rng& rng, std::int64_t id) {
  Track track;
  track.id = id;
  track.half_extents = Vec3(0.4, 0.3, 0.2);
  track.top_speed = 3.0;
  track.motion.start = at_seconds(10.0);
  for (int k = 0; k < 10; ++k) {
    CubicPiece piece{Duration{500'000}, PowerCubic::Zero()};
    for (Eigen::Index i = 0; i < piece.coefficients.size(); ++i) piece.coefficients(i) = rng.uniform(-1.0, 1.0);
    track.motion.pieces.push_back(piece);
    track.alpha.push_back(Vec3::Constant(0.01 * k));
  }
  return track;
}

bool same_bits(const CubicPiece& a, const CubicPiece& b) {
  return a.duration == b.duration &&
         std::memcmp(a.coefficients.data(), b.coefficients.data(), sizeof(double) * 12) == 0;
}

TEST(Trimmed, PassesPiecesOnBitForBit) {
  Rng rng(1);
  const Track track = random_track(rng, 4);
  const Track kept = trimmed({track}, at_seconds(11.2), Duration::from_seconds(1.5)).front();
  ASSERT_EQ(kept.motion.start, at_seconds(11.0));
  ASSERT_EQ(kept.motion.pieces.size(), 4u);  // 11.0 … 13.0 holds 11.2 … 12.7
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_TRUE(same_bits(kept.motion.pieces[k], track.motion.pieces[k + 2]));
    EXPECT_EQ(kept.alpha[k], track.alpha[k + 2]);
  }
  EXPECT_EQ(kept.id, track.id);
  EXPECT_EQ(kept.kind, track.kind);
  EXPECT_EQ(kept.half_extents, track.half_extents);
  EXPECT_EQ(kept.top_speed, track.top_speed);
}

TEST(Trimmed, EqualsTheDeclaredMotionOverTheHorizon) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Rng rng(seed);
    const Track track = random_track(rng, 1);
    const UTime now = at_seconds(rng.uniform(8.0, 17.0));
    const Duration horizon = Duration::from_seconds(rng.uniform(0.5, 6.0));
    const Track kept = trimmed({track}, now, horizon).front();
    for (int i = 0; i < 20; ++i) {
      const UTime t = now + Duration{static_cast<std::int64_t>(rng.uniform() * static_cast<double>(horizon.us))};
      EXPECT_EQ(kept.bounds(t, t).min(), track.bounds(t, t).min()) << "seed " << seed;
      EXPECT_EQ(kept.bounds(t, t).max(), track.bounds(t, t).max()) << "seed " << seed;
    }
  }
}

TEST(Trimmed, KeepsTheLastPieceOfATrackThatHasEnded) {
  Rng rng(2);
  const Track track = random_track(rng, 1);
  const Track kept = trimmed({track}, at_seconds(20.0), Duration::from_seconds(4.5)).front();
  ASSERT_EQ(kept.motion.pieces.size(), 1u);
  EXPECT_TRUE(same_bits(kept.motion.pieces.front(), track.motion.pieces.back()));
  EXPECT_EQ(kept.motion.end(), track.motion.end());
}

TEST(Trimmed, KeepsStatics) {
  Rng rng(3);
  Track track = random_track(rng, 1);
  track.kind = TrackKind::Static;
  track.motion.pieces.resize(1);
  track.alpha.resize(1);
  const Track kept = trimmed({track}, at_seconds(1e6), Duration::from_seconds(4.5)).front();
  EXPECT_EQ(kept.motion.start, track.motion.start);
  EXPECT_TRUE(same_bits(kept.motion.pieces.front(), track.motion.pieces.front()));
}

TEST(WithoutExplained, DropsDetectionsOfDeclaredTracksOnly) {
  Rng rng(4);
  const Track track = random_track(rng, 7);
  const Vec3 centre = track.motion.sample(at_seconds(11.3)).p;
  ObservationSet set;
  set.at = at_seconds(11.3);
  Detection inside, near, same_id, other;
  inside.position = centre + Vec3(0.4, 0.0, 0.0);
  near.position = centre + Vec3(0.5, 0.0, 0.0);  // 0.4 + α 0.02 + 4 √2 · 0.05
  near.variance = Vec3::Constant(0.0025);
  same_id.position = centre + Vec3(30.0, 0.0, 0.0);
  same_id.track_id = 7;
  other.position = centre + Vec3(0.71, 0.0, 0.0);
  other.variance = Vec3::Constant(0.0025);
  other.track_id = 8;
  set.detections = {inside, near, same_id, other};
  const ObservationSet left = without_explained(set, {track});
  ASSERT_EQ(left.detections.size(), 1u);
  EXPECT_EQ(left.detections.front().track_id, 8);
}

// A person beside a declared robot.
TEST(WithoutExplained, KeepsADetectionThatSticksOutOfTheDeclaredBox) {
  Track robot;
  robot.id = 1;
  robot.half_extents = Vec3(1.0, 1.0, 1.0);
  robot.motion.start = at_seconds(10.0);
  robot.motion.pieces = {CubicPiece{Duration{1'000'000}, PowerCubic::Zero()}};
  robot.alpha = {Vec3::Constant(0.01)};
  const auto is_dropped = [&](double y, double half) {
    ObservationSet set;
    set.at = at_seconds(10.5);
    Detection person;
    person.position = Vec3(0.0, y, 0.0);
    person.half_extents = Vec3::Constant(half);
    person.variance = Vec3::Constant(0.05 * 0.05);
    set.detections = {person};
    return without_explained(set, {robot}).detections.empty();
  };
  for (const double y : {0.9, 1.1, 1.3}) EXPECT_FALSE(is_dropped(y, 0.6)) << y;
  EXPECT_TRUE(is_dropped(0.2, 0.6)) << "a part of the robot";
  EXPECT_TRUE(is_dropped(0.2, 1.0)) << "the robot, seen 4 standard deviations beside where it is";
  EXPECT_FALSE(is_dropped(0.0, 1.4)) << "larger than the robot";
}

// Half a metre of σ would make a margin of 2.8 m.
TEST(WithoutExplained, KeepsAnUncertainDetectionOfAPersonBesideTheDeclaredBox) {
  Track robot;
  robot.half_extents = Vec3::Constant(0.6);
  robot.motion.start = at_seconds(10.0);
  robot.motion.pieces = {CubicPiece{Duration{1'000'000}, PowerCubic::Zero()}};
  robot.alpha = {Vec3::Zero()};
  ObservationSet set;
  SightingSet sightings;
  set.at = sightings.at = at_seconds(10.5);
  Detection person;
  person.position = Vec3(2.5, 0.0, 0.0);
  person.half_extents = Vec3::Constant(0.3);
  person.variance = Vec3::Constant(0.5 * 0.5);
  set.detections = {person};
  Sighting seen;
  seen.lower = person.position - person.half_extents;
  seen.upper = person.position + person.half_extents;
  seen.lower_sigma = seen.upper_sigma = Vec3::Constant(0.6);
  sightings.sightings = {seen};
  EXPECT_EQ(without_explained(set, {robot}).detections.size(), 1u);
  EXPECT_EQ(without_explained(sightings, {robot}).sightings.size(), 1u);
  set.detections[0].position.x() = 0.5;
  EXPECT_TRUE(without_explained(set, {robot}).detections.empty()) << "it sticks out by 0.2 m";
}

TEST(Merged, KeepsAnEstimateThatSticksOutOfTheDeclaredBox) {
  Rng rng(8);
  const Track declared = random_track(rng, 5);
  Track larger = declared;
  larger.id = 99;
  larger.half_extents += Vec3(0.2, 0.0, 0.0);
  EXPECT_EQ(merged({declared}, {larger}, at_seconds(11.0)).size(), 2u);
}

TEST(Merged, DeclaredTracksWinAndIdsAscend) {
  Rng rng(5);
  const Track declared = random_track(rng, 5);
  Track apart = random_track(rng, 2), same_id = random_track(rng, 5), within = declared;
  for (CubicPiece& piece : apart.motion.pieces) piece.coefficients.col(3).x() += 50.0;
  for (CubicPiece& piece : same_id.motion.pieces) piece.coefficients.col(3).x() += 90.0;
  within.id = 99;
  const std::vector<Track> all = merged({declared}, {apart, same_id, within}, at_seconds(11.0));
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].id, 2);
  EXPECT_EQ(all[1].id, 5);
  EXPECT_TRUE(same_bits(all[1].motion.pieces.front(), declared.motion.pieces.front()));
}

// A region that grows for seconds after its owner fell silent must not hide what is seen in it.
TEST(WithoutExplained, KeepsDetectionsWhereADeclaredTrackEndedLongAgo) {
  Rng rng(6);
  Track track = random_track(rng, 7);  // until 15 s
  ObservationSet set;
  set.detections = {Detection{}};
  set.detections.front().position = track.motion.sample(at_seconds(15.0)).p;
  set.detections.front().track_id = 7;
  set.at = at_seconds(15.2);
  EXPECT_TRUE(without_explained(set, {track}).detections.empty());
  set.at = at_seconds(17.0);
  EXPECT_EQ(without_explained(set, {track}).detections.size(), 1u);
  set.at = at_seconds(8.0);
  EXPECT_EQ(without_explained(set, {track}).detections.size(), 1u);
  track.kind = TrackKind::Static;
  EXPECT_TRUE(without_explained(set, {track}).detections.empty());
}

TEST(Merged, AnEstimateReplacesADeclaredTrackThatHasEnded) {
  Rng rng(7);
  const Track declared = random_track(rng, 5);
  Track estimate = random_track(rng, 5);
  estimate.kind = TrackKind::Estimated;
  const std::vector<Track> all = merged({declared}, {estimate}, at_seconds(20.0));
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].kind, TrackKind::Estimated);
  EXPECT_EQ(merged({declared}, {}, at_seconds(20.0)).size(), 1u);
}

}  // namespace
}  // namespace tern
