// When predictions are stored, evaluated and finished.
#include "predictor/tracking/prediction_log.h"

#include <gtest/gtest.h>

#include <utility>

namespace tern {
namespace {

constexpr double kPeriod = 0.05;  // s

UTime at(double t_s) { return UTime{1'000'000} + Duration::from_seconds(t_s); }

/// A track that moves along x at 1 m/s and is detected each kPeriod, from 0 on.
class PredictionLogTest : public ::testing::Test {
 protected:
  /// @return whether a prediction was stored
  bool detect(int n) {
    const double t = n * kPeriod;
    track_.detections = n + 1;
    track_.position = Vec3(t, 0.0, 0.0);
    TrackRecord& record = log_.add_detection(track_, at(t));
    PredictionLog::evaluate_due(
        record,
        [&](const StoredPrediction& prediction, const Measurement& truth) {
          evaluated_.emplace_back(prediction, truth);
        },
        finished_);
    if (!PredictionLog::is_storing_due(track_, at(t), record)) return false;
    PredictionLog::store(track_, at(t), record);
    return true;
  }

  BankFilter bank_{Vec3::Zero(), Vec3::Constant(1e-4)};
  DetectedTrack track_{7, at(0.0), 1, Vec3::Zero(), Vec3::Constant(1e-4), &bank_};
  PredictionLog log_;
  std::vector<std::pair<StoredPrediction, Measurement>> evaluated_;
  std::vector<ScoredPrediction> finished_;
};

TEST_F(PredictionLogTest, StoresTheFirstOnesAndThenOneInEachPeriod) {
  std::vector<int> stored;
  for (int n = 0; n < 20; ++n) {
    if (detect(n)) stored.push_back(n);
  }
  // Detections 1, 2, 3, 5 and 8 are n = 0, 1, 2, 4, 7. At n = 6 (0.3 s) the track is no longer young.
  EXPECT_EQ(stored, (std::vector<int>{0, 1, 2, 4, 6, 7, 12, 17}));
}

TEST_F(PredictionLogTest, EvaluatesEachTimeOnceAgainstTheTruth) {
  for (int n = 0; n <= 100; ++n) detect(n);
  std::size_t of_first = 0;
  for (const auto& [prediction, truth] : evaluated_) {
    EXPECT_EQ(truth.at, evaluation_time(prediction.at, prediction.next));
    EXPECT_NEAR(truth.z.x(), (truth.at - at(0.0)).seconds(), 1e-9);
    if (prediction.at != at(0.0)) continue;
    EXPECT_EQ(prediction.next, of_first++);
  }
  EXPECT_EQ(of_first, kEvaluatedAhead.size());
  EXPECT_EQ(finished_.size(), 5U) << "those stored up to 0.3 s are evaluated to their end, 4.5 s and the span later";
}

TEST_F(PredictionLogTest, FinishesAPredictionWhoseTruthIsUnknown) {
  for (int n = 0; n < 8; ++n) detect(n);
  for (int n = 60; n < 63; ++n) detect(n);
  EXPECT_EQ(finished_.size(), 6U) << "all that were made before the gap";
}

TEST_F(PredictionLogTest, ForgetsTheMotionOfAnotherBirthAndDeletedTracks) {
  for (int n = 0; n < 8; ++n) detect(n);
  track_.born = at(0.4);
  detect(8);
  EXPECT_EQ(log_.records().at(7).predictions.size(), 1U);
  EXPECT_EQ(log_.find(7, at(0.0)), nullptr);
  EXPECT_NE(log_.find(7, at(0.4)), nullptr);
  log_.keep_only({}, finished_);
  EXPECT_TRUE(log_.records().empty());
  EXPECT_EQ(finished_.size(), 1U);
}

}  // namespace
}  // namespace tern
