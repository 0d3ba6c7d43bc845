#include "monitor/estimate_watch.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"

namespace tern {
namespace {

UTime at_s(double t) { return UTime{1'000'000} + Duration::from_seconds(t); }

/// Flies along x at 5 m/s.
UavState truth_at(double t) {
  UavState truth;
  truth.at = at_s(t);
  truth.motion.p = Vec3(5.0 * t, 0.0, 1.0);
  truth.motion.v = Vec3(5.0, 0.0, 0.0);
  return truth;
}

Odometry odometry_at(double t, const Vec3& error, double sigma) {
  Odometry odometry;
  odometry.at = at_s(t);
  odometry.state = EstimatorState::Tracking;
  odometry.p_WO = Vec3(1.0, 2.0, 3.0);
  odometry.p_OB = truth_at(t).motion.p + error - odometry.p_WO;
  odometry.tracks = 50;
  for (const int k : {0, 7, 14}) odometry.pose_covariance[idx(k)] = sigma * sigma;
  return odometry;
}

TEST(EstimateWatch, HasNoMeasuresWithoutOdometryInFlight) {
  EstimateWatch watch;
  EXPECT_FALSE(watch.measures(Vec3::Zero()));
  watch.add_truth(truth_at(0.0));
  EXPECT_FALSE(watch.measures(Vec3::Zero()));
}

TEST(EstimateWatch, ComparesAtTheOdometrysOwnTimeInEitherOrder) {
  EstimateWatch watch;
  watch.add_truth(truth_at(0.0));
  watch.add(odometry_at(0.003, Vec3(0.0, 0.3, 0.0), 0.1));  // before the truth of 0.01 s is known
  watch.add_truth(truth_at(0.01));
  watch.add_truth(truth_at(0.02));
  watch.add(odometry_at(0.015, Vec3(0.1, 0.0, 0.0), 0.1));
  watch.add_believed(truth_at(0.015));
  const auto measures = watch.measures(Vec3(0.1, 0.0, 1.0));
  ASSERT_TRUE(measures);
  EXPECT_NEAR(measures->end_m, 0.1, 1e-12);
  EXPECT_NEAR(measures->peak_m, 0.3, 1e-12);
  EXPECT_NEAR(measures->rmse_m, std::sqrt((0.01 + 0.09) / 2.0), 1e-12);
  EXPECT_NEAR(measures->sigma_end_m, std::sqrt(0.03), 1e-12);
  EXPECT_NEAR(measures->true_to_goal_m, 0.0, 1e-12);
  EXPECT_NEAR(measures->believed_to_goal_m, 0.025, 1e-12);
}

TEST(EstimateWatch, ErrorsAsStatedGiveAneesOneAndCoverage) {
  Rng rng(1);
  EstimateWatch watch;
  watch.add_truth(truth_at(0.0));
  for (int k = 1; k <= 4000; ++k) {
    const double x = rng.normal(), y = rng.normal(), z = rng.normal();
    watch.add(odometry_at(0.01 * k, 0.2 * Vec3(x, y, z), 0.2));
    watch.add_truth(truth_at(0.01 * k));
  }
  const auto measures = watch.measures(Vec3::Zero());
  ASSERT_TRUE(measures);
  EXPECT_NEAR(measures->anees, 1.0, 0.06);  // five standard deviations of √(2/3/4000)
  EXPECT_NEAR(measures->coverage, 0.99, 0.008);
  EXPECT_EQ(measures->blind_s, 0.0);
}

TEST(EstimateWatch, CountsTheTimeWithFewTracks) {
  EstimateWatch watch;
  watch.add_truth(truth_at(0.0));
  for (int k = 1; k <= 100; ++k) {
    Odometry odometry = odometry_at(0.05 * k, Vec3::Zero(), 0.1);
    odometry.tracks = k > 60 ? 3 : 40;
    watch.add(odometry);
    watch.add_truth(truth_at(0.05 * k));
  }
  EXPECT_NEAR(watch.measures(Vec3::Zero())->blind_s, 2.0, 1e-9);
}

TEST(EstimateWatch, SaysNothingOfTracksThatNobodyStates) {
  EstimateWatch watch;
  watch.add_truth(truth_at(0.0));
  for (int k = 1; k <= 10; ++k) {
    Odometry odometry = odometry_at(0.05 * k, Vec3::Zero(), 0.1);
    odometry.tracks = 0;
    watch.add(odometry);
    watch.add_truth(truth_at(0.05 * k));
  }
  const EstimateMeasures measures = *watch.measures(Vec3::Zero());
  EXPECT_EQ(to_text(measures).find("nearly blind"), std::string::npos);
  EXPECT_NE(with_estimate("{}", measures).find("\"blind_s\": null"), std::string::npos);
}

}  // namespace
}  // namespace tern
