// The model that predicts best a second ahead is not the one that predicts the next detection best.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "predictor/tracking/tracker.h"
#include "tests/predictor/simulated_motion.h"

namespace tern {
namespace {

using testing::at_seconds;
using testing::Path;

constexpr double kRate = 16.0, kNoise = 0.01;
constexpr double kApart = 100.0;  // m

/// A walker's head: straight on, with a sway along the path at each step and sideways at every other one.
Path walker(Rng& rng, double y) {
  const double speed = rng.uniform(1.0, 1.6), steps = 2.0 * std::numbers::pi * rng.uniform(1.7, 2.0);
  const double phase = rng.uniform(0.0, 2.0 * std::numbers::pi);
  const Path way = testing::random_path(rng, Vec3(0, y, 1.6), Vec3(speed, 0, 0), 0.1, 40.0);
  return [=](double t) -> Vec3 {
    return way(t) + Vec3(0.015 * std::sin(steps * t + phase), 0.06 * std::sin(0.5 * steps * t + phase),
                         0.02 * std::cos(steps * t + phase));
  };
}

struct SquaredErrors {
  double by_next_detection = 0.0, by_scores_ahead = 0.0;
};

TEST(ModelChoice, WalkersArePredictedBetterByScoresAheadThanByTheLikelihoodOfTheNextDetection) {
  constexpr double kAhead = 2.0;
  Rng rng(4);
  std::vector<Path> walkers;
  for (int k = 0; k < 12; ++k) walkers.push_back(walker(rng, kApart * k));
  const BankOutputRows ahead = bank_output_rows(bank_step(kAhead), bank_step(0.0));
  Tracker tracker(TrackerConfig{});
  SquaredErrors errors;
  int predicted = 0;
  for (int frame = 0; frame < static_cast<int>(25.0 * kRate); ++frame) {
    const double t = frame / kRate;
    std::vector<Detection> seen;
    for (const Path& path : walkers) seen.push_back(testing::detection_of(path(t), kNoise, rng));
    tracker.update(testing::observations_at(t, std::move(seen)));
    if (t < 8.0 || frame % 8 != 0) continue;
    for (const TrackedObject& object : tracker.objects()) {
      const auto y = static_cast<std::size_t>(std::lround(object.position.y() / kApart));
      const std::size_t likeliest = object.moving.leading();
      const Vec3 truth = walkers.at(y)(t + kAhead);
      const PredictionScorer::Assessment assessment = tracker.assessment(object);
      const LearntCoefficients learnt = tracker.scorer().learnt().at(kAhead, assessment.group.value_or(0));
      const MixturePrediction said = mixture_prediction(
          object.moving, ahead, learnt_prediction(learnt, object.learnt_input), weights_at(assessment.weights, kAhead));
      errors.by_next_detection += (object.moving.lead().at(ahead[likeliest]).position - truth).squaredNorm();
      errors.by_scores_ahead += (said.centre - truth).squaredNorm();
      ++predicted;
    }
  }
  RecordProperty("rms", std::to_string(std::sqrt(errors.by_next_detection / predicted)) + " and " +
                            std::to_string(std::sqrt(errors.by_scores_ahead / predicted)));
  ASSERT_GT(predicted, 300);
  EXPECT_LT(errors.by_scores_ahead, 0.5 * errors.by_next_detection);
}

}  // namespace
}  // namespace tern
