#include "messages/batching.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "core/wire/message_limits.h"
#include "tests/messages/messages_under_test.h"
#include "tests/support/generators.h"
#include "tests/support/random_shares.h"
#include "tests/support/random_splines.h"

namespace tern {
namespace {

using support::random_integer;

/// Tracks by descending id, so that the given order and the joined order differ.
TrackSet random_set(Rng& rng, int tracks, int most_pieces) {
  TrackSet set;
  set.header = {{12, 3}, {45}};
  set.batch = {7, 0, 1};
  set.made_at = {40};
  set.confidence = 0.9;
  for (int i = 0; i < tracks; ++i)
    set.tracks.push_back(support::random_track(rng, tracks - i, random_integer(rng, 1, most_pieces)));
  return set;
}

ObstacleTruth random_truth(Rng& rng, int obstacles) {
  ObstacleTruth truth;
  truth.header = {{12, 3}, {45}};
  truth.batch = {7, 0, 1};
  for (int i = 0; i < obstacles; ++i) {
    truth.obstacles.push_back(
        {obstacles - i, support::random_vector(rng, 10.0), Vec3::Zero(), Vec3::Ones(), i % 2 == 0});
  }
  return truth;
}

template <class T>
void expect_legal_batches(const std::vector<T>& batches) {
  ASSERT_GE(batches.size(), 1U);
  ASSERT_LE(batches.size(), static_cast<std::size_t>(kMaxBatches));
  for (std::size_t i = 0; i < batches.size(); ++i) {
    EXPECT_EQ(batches[i].batch.set, 7);
    EXPECT_EQ(batches[i].batch.index, static_cast<int>(i));
    EXPECT_EQ(batches[i].batch.count, static_cast<int>(batches.size()));
    EXPECT_TRUE(decode<T>(encode(batches[i])));
  }
}

/// Returns walking people at 120 frames/s, with straight motion between frames.
TrackSet walkers(int people, int pieces) {
  TrackSet set;
  set.header = {{12, 3}, {45}};
  set.batch = {7, 0, 1};
  const Duration frame{8'333};
  for (int id = 0; id < people; ++id) {
    Track track;
    track.id = id;
    track.half_extents = Vec3(0.25, 0.25, 1.0);
    track.top_speed = 3.0;
    track.alpha.resize(static_cast<std::size_t>(pieces), Vec3::Constant(1e-9));
    const auto at = [id, frame](int k) {
      const double t = (frame * k).seconds() + 0.1 * id;
      return Vec3(1.3 * t - id, std::sin(1.1 * t), 1.0 + 0.03 * std::sin(12.0 * t));
    };
    for (int k = 0; k < pieces; ++k) {
      CubicPiece piece{frame, PowerCubic::Zero()};
      piece.coefficients.col(2) = (at(k + 1) - at(k)) / frame.seconds();
      piece.coefficients.col(3) = at(k);
      track.motion.pieces.push_back(piece);
    }
    set.tracks.push_back(std::move(track));
  }
  return set;
}

/// True if the coarse track's box contains the track's box: at the ends, in the middle, and outside both ends.
void expect_contains(const Track& coarse, const Track& track) {
  const Duration whole = track.motion.end() - track.motion.start;
  for (int i = -2; i <= 22; ++i) {
    const UTime t = track.motion.start + Duration{whole.us * i / 20};
    ASSERT_TRUE(coarse.bounds(t, t).contains(track.bounds(t, t))) << "track " << track.id << " at " << i << "/20";
  }
}

/// Returns the whole set as it is after sending and joining: sorted by id.
TrackSet sorted(TrackSet set) {
  std::sort(set.tracks.begin(), set.tracks.end(), [](const Track& a, const Track& b) { return a.id < b.id; });
  return set;
}

TEST(Batches, OfTracksJoinToTheWholeWhateverTheirSizes) {
  Rng rng(9);
  for (int i = 0; i < 200; ++i) {
    const TrackSet whole = random_set(rng, random_integer(rng, 0, 120), random_integer(rng, 1, 20));
    const auto batches = split_batches(whole);
    expect_legal_batches(batches);
    EXPECT_EQ(words_of(join_batches(batches)), words_of(sorted(whole)));
  }
}

TEST(Batches, KeepTheFirstTracksAndCountTheOthersAsLeftOut) {
  Rng rng(10);
  TrackSet whole = random_set(rng, 2500, 1);
  whole.left_out = 5;
  const auto batches = split_batches(whole);
  expect_legal_batches(batches);
  std::size_t sent = 0;
  for (const TrackSet& batch : batches) {
    for (const Track& track : batch.tracks) EXPECT_EQ(track.id, whole.tracks[sent++].id);
  }
  EXPECT_LT(sent, whole.tracks.size());
  for (const TrackSet& batch : batches) EXPECT_EQ(batch.left_out, 5 + static_cast<int>(whole.tracks.size() - sent));
}

TEST(Batches, FillTheirMessages) {
  Rng rng(11);
  const auto many = split_batches(random_set(rng, 2500, 1));
  ASSERT_EQ(many.size(), static_cast<std::size_t>(kMaxBatches));
  for (const TrackSet& batch : many) {
    EXPECT_TRUE(batch.tracks.size() == kMaxTracksPerBatch || encode(batch).size() > kMaxMessageBytes * 99UL / 100);
  }
  const auto few = split_batches(walkers(100, 552));
  ASSERT_EQ(few.size(), static_cast<std::size_t>(kMaxBatches));
  for (std::size_t k = 0; k + 1 < few.size(); ++k)
    EXPECT_GT(encode(few[k]).size(), static_cast<std::size_t>(kMaxMessageBytes) * 9 / 10);
}

TEST(Batches, MakeTracksCoarserRatherThanLeaveThemOut) {
  for (const auto& [people, pieces] : {std::pair{1, 10'000}, {12, 552}, {100, 552}, {600, 46}, {1800, 9}}) {
    const TrackSet whole = walkers(people, pieces);
    const auto batches = split_batches(whole);
    expect_legal_batches(batches);
    const TrackSet sent = join_batches(batches);
    EXPECT_EQ(sent.left_out, 0);
    ASSERT_EQ(sent.tracks.size(), whole.tracks.size());
    for (std::size_t k = 0; k < sent.tracks.size(); ++k) expect_contains(sent.tracks[k], whole.tracks[k]);
    EXPECT_GE(sent.tracks.front().motion.pieces.size(), sent.tracks.back().motion.pieces.size())
        << "the first is finer";
  }
}

TEST(Batches, HoldAHundredEstimatedTracksAsTheyAre) {
  TrackSet whole = walkers(100, 20);
  for (Track& track : whole.tracks) {
    track.kind = TrackKind::Estimated;
    track.shares.assign(track.alpha.size(), on_all_axes({0.9F, 0.8F, 0.7F, 0.5F}));
  }
  const auto batches = split_batches(whole);
  expect_legal_batches(batches);
  EXPECT_EQ(words_of(join_batches(batches)), words_of(sorted(whole)));
}

TEST(Batches, HoldAHundredPredictionsWithSharesOfEachAxisAsTheyAre) {
  constexpr int kPieces = 18;  // of PredictionSpec
  TrackSet whole = walkers(100, kPieces);
  Rng rng(12);
  for (Track& track : whole.tracks) {
    track.kind = TrackKind::Estimated;
    for (int k = 0; k < kPieces; ++k) track.shares.push_back(support::random_shares(rng));
  }
  const auto batches = split_batches(whole);
  expect_legal_batches(batches);
  EXPECT_EQ(words_of(join_batches(batches)), words_of(sorted(whole)));
}

TEST(Batches, MakeARecordingOfAHundredPeopleCoarserByLessThanACentimetre) {
  for (const TrackSet& batch : split_batches(walkers(100, 552))) {
    for (const Track& track : batch.tracks) {
      for (const Vec3& alpha : track.alpha) EXPECT_LE(alpha.maxCoeff(), 0.01);
    }
  }
}

TEST(Batches, LeaveOutATrackWhoseCoarseNumbersNoMessageHoldsButNotTheOnesAfterIt) {
  Rng rng(12);
  TrackSet whole = random_set(rng, 3, 2);
  whole.tracks[1] = support::random_track(rng, 2, kMaxPiecesPerBatch + 1);
  for (CubicPiece& piece : whole.tracks[1].motion.pieces) piece.duration = kMaxSpan;
  const auto batches = split_batches(whole);
  ASSERT_EQ(batches.size(), 1U);
  expect_legal_batches(batches);
  EXPECT_EQ(batches[0].left_out, 1);
  ASSERT_EQ(batches[0].tracks.size(), 2U);
  EXPECT_EQ(batches[0].tracks[1].id, whole.tracks[2].id);
}

TEST(Batches, HoldAsManyPiecesForEachAsIsSaid) {
  for (const auto& [tracks, single] :
       {std::pair<std::size_t, std::size_t>{1, 0}, {7, 100}, {100, 0}, {100, 300}, {1900, 0}}) {
    const std::size_t most = pieces_for_each(tracks, single);
    ASSERT_GE(most, 1U);
    TrackSet whole = walkers(static_cast<int>(tracks), static_cast<int>(most));
    for (Track& one : walkers(static_cast<int>(single), 1).tracks) whole.tracks.push_back(std::move(one));
    const auto batches = split_batches(whole);
    EXPECT_EQ(batches[0].left_out, 0);
    EXPECT_EQ(batches[0].tracks[0].motion.pieces.size(), most) << "as they were";
  }
  EXPECT_EQ(pieces_for_each(2500, 0), 0U);
  EXPECT_EQ(pieces_for_each(1, 2500), 0U);
}

TEST(Batches, HoldTheLongestTrack) {
  Rng rng(13);
  TrackSet whole = random_set(rng, 0, 1);
  whole.tracks.push_back(support::random_track(rng, 1, kMaxPiecesPerBatch));
  EXPECT_EQ(split_batches(whole)[0].left_out, 0);
}

TEST(Batches, OfNothingAreOneEmptyBatch) {
  Rng rng(14);
  const auto tracks = split_batches(random_set(rng, 0, 1));
  expect_legal_batches(tracks);
  EXPECT_EQ(tracks.size(), 1U);
  EXPECT_TRUE(join_batches(tracks).tracks.empty());
  EXPECT_EQ(split_batches(random_truth(rng, 0)).size(), 1U);
}

TEST(Batches, OfObstaclesJoinToTheWholeOrCountWhatIsLeftOut) {
  Rng rng(15);
  for (const int n : {1, kMaxObstaclesPerBatch, kMaxObstaclesPerBatch + 1, kMaxBatches * kMaxObstaclesPerBatch, 5000}) {
    const ObstacleTruth whole = random_truth(rng, n);
    const auto batches = split_batches(whole);
    expect_legal_batches(batches);
    const ObstacleTruth joined = join_batches(batches);
    EXPECT_EQ(joined.left_out, std::max(0, n - kMaxBatches * kMaxObstaclesPerBatch));
    EXPECT_EQ(static_cast<int>(joined.obstacles.size()) + joined.left_out, n);
    EXPECT_TRUE(std::is_sorted(joined.obstacles.begin(), joined.obstacles.end(),
                               [](const auto& a, const auto& b) { return a.id < b.id; }));
  }
}

TEST(Batches, ThatDisagreeJoinToTheCarefulValue) {
  Rng rng(16);
  TrackSet a = random_set(rng, 2, 1);
  TrackSet b = random_set(rng, 2, 1);
  b.made_at = {30};
  b.confidence = 0.5;
  b.left_out = 4;
  const TrackSet joined = join_batches({a, b});
  EXPECT_EQ(joined.made_at, UTime{30});
  EXPECT_EQ(joined.confidence, 0.5);
  EXPECT_EQ(joined.left_out, 4);
  EXPECT_EQ(joined.tracks.size(), 4U);
  EXPECT_THROW(join_batches(std::vector<TrackSet>{}), std::invalid_argument);
}

}  // namespace
}  // namespace tern
