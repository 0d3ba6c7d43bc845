#include "core/world/resampling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "core/base/random.h"
#include "core/wire/message_limits.h"
#include "tests/support/random_shares.h"
#include "tests/support/random_splines.h"

namespace tern {
namespace {

using support::random_integer;
using support::random_vector;

/// Returns a random track with jumps, corners and rests. Pieces last from 1 µs to seconds, and α has any size.
Track random_track(Rng& rng, int pieces) {
  Track track;
  track.half_extents = Vec3(0.3, 0.2, 1.0);
  track.top_speed = 3.0;
  track.motion.start = {1'700'000'000'000'000 + random_integer(rng, 0, 1'000'000)};
  const double from_origin = rng.uniform() < 0.5 ? 10.0 : 1e5;
  Vec3 p = random_vector(rng, from_origin);
  const bool jumps = rng.uniform() < 0.3, bends = rng.uniform() < 0.5, estimated = rng.uniform() < 0.5;
  for (int k = 0; k < pieces; ++k) {
    const Duration length{rng.uniform() < 0.1 ? random_integer(rng, 1, 1000) : random_integer(rng, 1000, 100'000)};
    const double h = length.seconds();
    CubicPiece piece{length, PowerCubic::Zero()};
    piece.coefficients.col(3) = p;
    if (rng.uniform() > 0.2) piece.coefficients.col(2) = random_vector(rng, 3.0);
    if (bends) piece.coefficients.col(1) = random_vector(rng, 5.0);
    if (bends) piece.coefficients.col(0) = random_vector(rng, 10.0);
    p = sample_cubic(piece.coefficients, h).p;
    if (jumps && rng.uniform() < 0.1) p += random_vector(rng, 1.0);
    track.motion.pieces.push_back(piece);
    track.alpha.push_back(rng.uniform() < 0.5 ? Vec3(Vec3::Zero()) : Vec3(random_vector(rng, 0.2).cwiseAbs()));
    if (estimated) track.shares.push_back(support::random_shares(rng));
  }
  return track;
}

/// The slow oracle: compares every old piece at many instants with every new piece at that instant.
void expect_contains(const Track& now, const Track& before) {
  ASSERT_EQ(now.motion.start, before.motion.start);
  ASSERT_EQ(now.motion.end(), before.motion.end());
  ASSERT_EQ(now.alpha.size(), now.motion.pieces.size());
  ASSERT_EQ(now.shares.size(), before.shares.empty() ? 0 : now.alpha.size());
  UTime start = before.motion.start;
  for (std::size_t k = 0; k < before.motion.pieces.size(); ++k) {
    const CubicPiece& piece = before.motion.pieces[k];
    for (int i = 0; i <= 20; ++i) {
      const Duration tau{piece.duration.us * i / 20};
      const Vec3 p = sample_cubic(piece.coefficients, tau.seconds()).p;
      // At a joint of the new track, the piece on the side of the old piece is used.
      PiecewiseCubic::Located at = now.motion.locate(start + tau);
      if (i == 20 && at.index > 0 && at.start == start + tau) {
        --at.index;
        at.start = at.start - now.motion.pieces[at.index].duration;
      }
      const Vec3 q = sample_cubic(now.motion.pieces[at.index].coefficients, (start + tau - at.start).seconds()).p;
      for (int level = 0; level < kLevels; ++level) {
        const Vec3 alpha = now.alpha_at(at.index, level);
        const Vec3 room = alpha - before.alpha_at(k, level) - (q - p).cwiseAbs();
        ASSERT_GE(room.minCoeff(), 0.0) << "piece " << k << " at " << i << "/20, level " << level;
      }
    }
    start = start + piece.duration;
  }
}

/// Returns straight pieces of one length along a motion, as recordings have them.
Track recording(double frames_per_second, double seconds, const MotionFunction& motion) {
  Track track;
  const auto frames = static_cast<int>(seconds * frames_per_second);
  const Duration frame = Duration::from_seconds(1.0 / frames_per_second);
  for (int k = 0; k < frames; ++k) {
    CubicPiece piece{frame, PowerCubic::Zero()};
    const Vec3 from = motion(frame * k).p;
    piece.coefficients.col(2) = (motion(frame * (k + 1)).p - from) / frame.seconds();
    piece.coefficients.col(3) = from;
    track.motion.pieces.push_back(piece);
  }
  track.alpha.resize(track.motion.pieces.size(), Vec3::Zero());
  return track;
}

MotionSample walker(Duration t) {
  const double s = t.seconds();
  return {Vec3(1.4 * s, 0.3 * std::sin(1.3 * s), 1.0 + 0.03 * std::sin(4.0 * std::numbers::pi * s)), Vec3::Zero(),
          Vec3::Zero(), Vec3::Zero()};
}

double largest_alpha(const Track& track) {
  double largest = 0.0;
  for (const Vec3& alpha : track.alpha) largest = std::max(largest, alpha.maxCoeff());
  return largest;
}

TEST(ResampledTrack, ContainsTheTrackAtAllTimesInAtMostSoManyPieces) {
  Rng rng(1);
  for (int i = 0; i < 600; ++i) {
    const Track track = random_track(rng, random_integer(rng, 1, 150));
    const auto most = static_cast<std::size_t>(random_integer(rng, 1, 60));
    const Track coarse = resampled(track, most);
    ASSERT_LE(coarse.motion.pieces.size(), most);
    ASSERT_EQ(coarse.motion.pieces.size(), std::min(most, track.motion.pieces.size()));
    ASSERT_NO_FATAL_FAILURE(expect_contains(coarse, track)) << "track " << i;
  }
}

TEST(ResampledTrack, ContainsTheTrackBeyondItsEnds) {
  Rng rng(2);
  for (int i = 0; i < 100; ++i) {
    const Track track = random_track(rng, 40);
    const Track coarse = resampled(track, 5);
    for (const double beyond_s : {-3.0, -0.01, 0.01, 2.0}) {
      const UTime t = (beyond_s < 0.0 ? track.motion.start : track.motion.end()) + Duration::from_seconds(beyond_s);
      EXPECT_TRUE(coarse.bounds(t, t).contains(track.bounds(t, t)));
    }
  }
}

TEST(ResampledTrack, OfNoMorePiecesIsTheTrackItself) {
  Rng rng(3);
  const Track track = random_track(rng, 20);
  const Track same = resampled(track, 20);
  ASSERT_EQ(same.motion.pieces.size(), 20u);
  for (std::size_t k = 0; k < 20; ++k) {
    EXPECT_EQ(same.motion.pieces[k].coefficients, track.motion.pieces[k].coefficients);
    EXPECT_EQ(same.alpha[k], track.alpha[k]);
  }
}

TEST(ResampledTrack, OfACutCubicIsThatCubic) {
  const auto cubic = [](Duration t) {
    const double s = t.seconds();
    return MotionSample{Vec3(s * s * s - s, 2.0 * s * s, 7.0), Vec3(3.0 * s * s - 1.0, 4.0 * s, 0.0), {}, {}};
  };
  Track track;
  track.motion = hermite_fit({}, Duration{20'000}, 200, cubic);
  track.alpha.resize(200, Vec3::Constant(0.01));
  EXPECT_LE(largest_alpha(resampled(track, 1)), 0.01 + 1e-9);
}

TEST(ResampledTrack, OfAWalkerRecordedAtAnyRateIsAFewMillimetresOff) {
  for (const double rate : {101.0, 120.0, 1000.0}) {
    const Track track = recording(rate, 4.6, walker);
    const Track coarse = resampled(track, 40);
    expect_contains(coarse, track);
    EXPECT_LE(largest_alpha(coarse), 2e-3) << rate;
  }
}

TEST(ResampledTrack, OfAStraightLineOfManyPointsIsOneLine) {
  const Track track = recording(2000.0, 5.0, [](Duration t) {
    return MotionSample{Vec3(t.seconds(), 0.0, 1.0), {}, {}, {}};
  });
  const Track coarse = resampled(track, 1);
  EXPECT_LE(largest_alpha(coarse), 1e-9);
}

/// Returns the smallest possible largest error of `most` runs, each with its best cubic, by trying all cuts.
double best_of_all(const Track& track, std::size_t first, std::size_t most) {
  const std::size_t n = track.motion.pieces.size();
  if (first == n) return 0.0;
  if (most == 0) return 1e300;
  double best = 1e300;
  Track run;
  for (std::size_t last = first; last < n; ++last) {
    run.motion.pieces.push_back(track.motion.pieces[last]);
    run.alpha.push_back(track.alpha[last]);
    const double here = largest_alpha(resampled(run, 1));
    if (here < best) best = std::min(best, std::max(here, best_of_all(track, last + 1, most - 1)));
  }
  return best;
}

TEST(ResampledTrack, IsNotFarFromTheBestCut) {
  Rng rng(5);
  double worst = 0.0;
  for (int i = 0; i < 40; ++i) {
    Track track = random_track(rng, 12);
    for (Vec3& alpha : track.alpha) alpha.setZero();
    const double best = best_of_all(track, 0, 4);
    worst = std::max(worst, largest_alpha(resampled(track, 4)) / best);
  }
  RecordProperty("worst_ratio", std::to_string(worst));
  EXPECT_LE(worst, 4.0);
}

TEST(ResampledTrack, HoldsNumbersThatAMessageHolds) {
  Track track;
  for (int k = 0; k < 12; ++k) {
    CubicPiece piece{Duration{1}, PowerCubic::Zero()};
    piece.coefficients.col(3) = Vec3::Constant(k % 3 == 0 ? 1.0 : -1.0);
    track.motion.pieces.push_back(piece);
    track.alpha.emplace_back(Vec3::Zero());
  }
  for (const std::size_t most : {1u, 2u, 5u}) {
    const Track coarse = resampled(track, most);
    expect_contains(coarse, track);
    for (const CubicPiece& piece : coarse.motion.pieces) {
      EXPECT_LE(piece.coefficients.col(0).cwiseAbs().maxCoeff(), kMaxJerk);
      EXPECT_LE(piece.coefficients.col(1).cwiseAbs().maxCoeff(), kMaxAcceleration);
      EXPECT_LE(piece.coefficients.col(2).cwiseAbs().maxCoeff(), kMaxSpeed);
    }
  }
}

TEST(ResampledTrack, OfNothingOrToNothingIsACallersBug) {
  Rng rng(4);
  EXPECT_THROW((void)resampled(random_track(rng, 3), 0), std::invalid_argument);
  EXPECT_THROW((void)resampled(Track{}, 1), std::invalid_argument);
}

}  // namespace
}  // namespace tern
