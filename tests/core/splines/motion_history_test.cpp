#include "core/splines/motion_history.h"

#include <gtest/gtest.h>

#include "core/base/random.h"

namespace tern {
namespace {

constexpr UTime kStart{1'000'000};

CubicPiece random_piece(Rng& rng) {
  CubicPiece piece{Duration{1 + static_cast<std::int64_t>(rng.uniform() * 20'000.0)}, PowerCubic::Zero()};
  for (int k = 0; k < 12; ++k) piece.coefficients.data()[k] = rng.uniform() - 0.5;
  return piece;
}

TEST(MotionHistory, RestsBeforeItsFirstPieceAndEndsWithItsLast) {
  MotionHistory history(Vec3(1, 2, 3), kStart);
  EXPECT_EQ(history.end(), kStart);
  EXPECT_EQ(history.sample(kStart).p, Vec3(1, 2, 3));
  EXPECT_THROW((void)history.sample(kStart + Duration{1}), std::invalid_argument);
  CubicPiece piece{Duration{10'000}, PowerCubic::Zero()};
  piece.coefficients.col(2) = Vec3(1, 0, 0);
  history.append(piece);
  EXPECT_EQ(history.end(), kStart + Duration{10'000});
  EXPECT_EQ(history.sample(kStart - Duration{1}).p, Vec3(1, 2, 3));
  EXPECT_NEAR(history.sample(history.end()).p.x(), 0.01, 1e-15);
  EXPECT_THROW(history.append(CubicPiece{}), std::invalid_argument);
}

TEST(MotionHistory, ItsPiecesAreTheSameMotionHoweverTheyAreCutAndForgotten) {
  Rng rng(1);
  MotionHistory history(Vec3::Zero(), kStart);
  PiecewiseCubic whole{kStart, {}};
  for (int k = 0; k < 200; ++k) {
    whole.pieces.push_back(random_piece(rng));
    history.append(whole.pieces.back());
  }
  const auto span = static_cast<double>((history.end() - kStart).us);
  for (int k = 0; k < 500; ++k) {
    const UTime from = kStart + Duration{static_cast<std::int64_t>(rng.uniform() * span * 0.9)};
    const UTime to = from + Duration{1 + static_cast<std::int64_t>(rng.uniform() * span * 0.09)};
    const PiecewiseCubic cut = history.pieces(from, to);
    ASSERT_EQ(cut.start, from);
    ASSERT_EQ(cut.end(), to);
    const UTime at = from + Duration{static_cast<std::int64_t>(rng.uniform() * static_cast<double>((to - from).us))};
    EXPECT_LT((cut.sample(at).p - whole.sample(at).p).norm(), 1e-12);
    EXPECT_LT((history.sample(at).p - whole.sample(at).p).norm(), 1e-12);
    if (k == 250) history.forget_before(kStart);
  }
  const UTime middle = kStart + Duration{static_cast<std::int64_t>(span / 2)};
  history.forget_before(middle);
  EXPECT_LT((history.sample(middle).p - whole.sample(middle).p).norm(), 1e-12);
  EXPECT_NO_THROW((void)history.sample(kStart));
}

}  // namespace
}  // namespace tern
