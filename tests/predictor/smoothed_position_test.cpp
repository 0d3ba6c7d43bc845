// Where a track was, by the detections around that time.
#include "predictor/tracking/smoothed_position.h"

#include <gtest/gtest.h>

#include "core/base/random.h"

namespace tern {
namespace {

constexpr double kVariance = 0.01;  // m²

UTime at(double t_s) { return UTime{1'000'000} + Duration::from_seconds(t_s); }

Vec3 parabola(double t) { return Vec3(1.0 + 2.0 * t - 3.0 * t * t, -t, 0.5 * t * t); }

std::vector<Measurement> detections(const std::vector<double>& times_s) {
  std::vector<Measurement> all;
  for (const double t : times_s) all.push_back({at(t), parabola(t), Vec3::Constant(kVariance)});
  return all;
}

TEST(SmoothedPosition, OfAParabolaIsExact) {
  const std::vector<Measurement> seen = detections({0.0, 0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4});
  for (const double t : {0.05, 0.17, 0.2, 0.31}) {
    const auto smoothed = smoothed_position(seen, at(t));
    ASSERT_TRUE(smoothed);
    EXPECT_LT((smoothed->z - parabola(t)).norm(), 1e-9) << t;
    EXPECT_EQ(smoothed->at, at(t));
  }
}

TEST(SmoothedPosition, HasTheVarianceOfItsSpread) {
  constexpr int kTrials = 4000;
  Rng rng(1);
  Vec3 squares = Vec3::Zero(), variance = Vec3::Zero();
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<Measurement> seen = detections({0.0, 0.07, 0.13, 0.21, 0.26, 0.33, 0.4});
    for (Measurement& one : seen) {
      for (int axis = 0; axis < 3; ++axis) one.z[axis] += std::sqrt(kVariance) * rng.normal();
    }
    const auto smoothed = smoothed_position(seen, at(0.2));
    squares += (smoothed->z - parabola(0.2)).cwiseAbs2() / kTrials;
    variance = smoothed->r;
  }
  // Four standard deviations of a mean of so many squares.
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(squares[axis] / variance[axis], 1.0, 4.0 * std::sqrt(2.0 / kTrials));
  EXPECT_LT(variance.maxCoeff(), kVariance);
}

TEST(SmoothedPosition, IsALineBetweenTwoNeighboursWhereFewAreNear) {
  const std::vector<Measurement> seen = detections({0.0, 0.4});
  const auto middle = smoothed_position(seen, at(0.1));
  ASSERT_TRUE(middle);
  EXPECT_LT((middle->z - (0.75 * parabola(0.0) + 0.25 * parabola(0.4))).norm(), 1e-9);
  EXPECT_NEAR(middle->r.x(), (0.75 * 0.75 + 0.25 * 0.25) * kVariance, 1e-12);
}

/// Where two sensors measure at the same times, four detections may be of two instants only.
TEST(SmoothedPosition, OfTwoSensorsAtTheSameTimesStaysNearTheirDetections) {
  for (const double apart_s : {0.0, 1e-6, 1e-3}) {
    for (const double period_s : {0.05, 0.1, 0.15, 1.0 / 6.0, 0.2, 0.25, 0.4}) {
      std::vector<Measurement> seen;
      for (double t = 0.0; t < 2.0; t += period_s) {
        seen.push_back({at(t), Vec3(t, 0.01, 1.0), Vec3::Constant(kVariance)});
        seen.push_back({at(t + apart_s), Vec3(t, -0.01, 1.0), Vec3::Constant(kVariance)});
      }
      for (double t = 0.05; t < 1.5; t += 0.025) {
        const auto smoothed = smoothed_position(seen, at(t));
        ASSERT_TRUE(smoothed);
        EXPECT_LT((smoothed->z - Vec3(t, 0.0, 1.0)).norm(), 0.03) << t << ", " << period_s << ", " << apart_s;
        EXPECT_LT(smoothed->r.maxCoeff(), 2.0 * kVariance);
      }
    }
  }
}

TEST(SmoothedPosition, IsUnknownInAGapAndBeyondTheDetections) {
  EXPECT_FALSE(smoothed_position(detections({0.0, 0.05, 0.6, 0.65}), at(0.3))) << "a gap of more than kMaxGap";
  EXPECT_FALSE(smoothed_position(detections({0.1, 0.15, 0.2, 0.25}), at(0.05)));
  EXPECT_FALSE(smoothed_position(detections({0.1, 0.15, 0.2, 0.25}), at(0.3)));
  EXPECT_FALSE(smoothed_position({}, at(0.3)));
}

}  // namespace
}  // namespace tern
