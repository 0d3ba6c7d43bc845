// The learnt model: the law that it finds, its spline, the effect of outliers, and a tracker that uses it.
#include "predictor/models/learnt_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "core/base/random.h"
#include "predictor/tracking/tracker.h"
#include "tests/predictor/simulated_motion.h"

namespace tern {
namespace {

using testing::Path;

constexpr double kPi = std::numbers::pi;
constexpr std::size_t kOldest = kLearntGroups - 1;

LearntInput drawn(Rng& rng) {
  LearntInput track;
  track.position = Vec3(rng.uniform(-50, 50), rng.uniform(-50, 50), rng.uniform(0, 5));
  for (double& x : track.features) x = rng.normal();
  return track;
}

// A linear law: the offset from constant velocity, per feature, of the size of Taylor's terms.
FeatureCoefficients law(std::size_t horizon) {
  Rng rng(40 + horizon);
  FeatureCoefficients weights;
  for (int axis = 0; axis < 3; ++axis) {
    for (int i = 0; i < kFeatures; ++i) {
      const auto order = 1 + i % kFeaturesPerAxis;
      const double scale =
          order < kFeaturesPerAxis ? std::pow(kLearntAhead[horizon], order) / std::tgamma(order + 1) : 1.0;
      weights(i, axis) = scale * rng.normal();
    }
  }
  return weights;
}

Vec3 true_position(const LearntInput& track, std::size_t horizon) {
  const Features& x = track.features;
  const Vec3 velocity(x[0], x[kFeaturesPerAxis], x[2 * kFeaturesPerAxis]);
  return track.position + kLearntAhead[horizon] * velocity + law(horizon).transpose() * x;
}

struct SampleSource {
  int samples = 0;
  Vec3 noise = Vec3::Constant(0.01);  // m
  double outliers = 0.0;              // share of samples with another law
  std::size_t first_group = 0;        // samples go to the groups from here on, in turn
};

void add_samples(LearntModel& model, const SampleSource& source, Rng& rng) {
  for (int n = 0; n < source.samples; ++n) {
    const LearntInput track = drawn(rng);
    const bool is_outlier = rng.uniform() < source.outliers;
    const std::size_t group = source.first_group + static_cast<std::size_t>(n) % (kLearntGroups - source.first_group);
    for (std::size_t h = 0; h < kLearntTimes; ++h) {
      Vec3 observed = true_position(track, h);
      for (int axis = 0; axis < 3; ++axis) {
        observed[axis] += source.noise[axis] * rng.normal() + (is_outlier ? 20.0 * rng.normal() : 0.0);
      }
      model.add_sample(h, group, track, observed, Vec3::Constant(1e-6), 1.0);
    }
    model.refit();
  }
}

double rms_error(const LearntModel& model, Rng& rng) {
  double sum = 0.0;
  constexpr int kTracks = 100;
  for (int n = 0; n < kTracks; ++n) {
    const LearntInput track = drawn(rng);
    for (std::size_t h = 0; h < kLearntTimes; ++h) {
      sum += (learnt_prediction(model.at(kLearntAhead[h], kOldest), track).position - true_position(track, h))
                 .squaredNorm();
    }
  }
  return std::sqrt(sum / (3.0 * kTracks * kLearntTimes));
}

TEST(LearntModel, FindsALinearLawInNoise) {
  Rng rng(1);
  LearntModel model;
  EXPECT_EQ(model.horizon_s(kOldest), 0.0);
  add_samples(model, {.samples = 1000}, rng);
  EXPECT_EQ(model.horizon_s(0), kLearntAhead.back());
  EXPECT_EQ(model.horizon_s(kOldest), kLearntAhead.back());
  EXPECT_LT(rms_error(model, rng), 0.01);
}

TEST(LearntModel, OneOutlierInTwentySamplesHardlyChangesIt) {
  Rng rng(2);
  LearntModel model;
  add_samples(model, {.samples = 800, .outliers = 0.05}, rng);
  EXPECT_LT(rms_error(model, rng), 0.03);
}

TEST(LearntModel, EstimatesItsOwnVariance) {
  // 40 residuals per time ahead determine a deviation to 11 % (1σ), and the mean of four models to half of that.
  constexpr int kFittedModels = 4;
  std::array<Vec3, kLearntTimes> mean;
  mean.fill(Vec3::Zero());
  for (std::uint64_t seed = 3; seed < 3 + kFittedModels; ++seed) {
    Rng rng(seed);
    LearntModel model;
    add_samples(model, {.samples = 1200, .noise = Vec3(0.1, 0.2, 0.3)}, rng);
    for (std::size_t h = 0; h < kLearntTimes; ++h) {
      mean[h] += model.at(kLearntAhead[h], kOldest).variance.cwiseSqrt() / kFittedModels;
    }
  }
  // Student's t gives outliers less weight, so it underestimates Gaussian noise a little.
  for (std::size_t h = 0; h < kLearntTimes; ++h) {
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_GT(mean[h][axis], 0.07 * (axis + 1)) << kLearntAhead[h];
      EXPECT_LT(mean[h][axis], 0.11 * (axis + 1)) << kLearntAhead[h];
    }
  }
}

// Adds a sample of one group at all times ahead: the law `by`, and noise.
template <typename Law>
void add_one_sample(LearntModel& model, std::size_t group, double noise, Rng& rng, const Law& by) {
  const LearntInput track = drawn(rng);
  for (std::size_t h = 0; h < kLearntTimes; ++h) {
    const Vec3 observed = by(track, h) + noise * Vec3(rng.normal(), rng.normal(), rng.normal());
    model.add_sample(h, group, track, observed, Vec3::Constant(1e-6), 1.0);
  }
}

TEST(LearntModel, ExactSamplesOfOldTracksDoNotOutweighNoisyOnesOfYoungTracks) {
  Rng rng(7);
  LearntModel model;
  const auto otherwise = [](const LearntInput& track, std::size_t h) {
    return Vec3(true_position(track, h) - 0.5 * (law(h).transpose() * track.features));
  };
  for (int n = 0; n < 300; ++n) {
    add_one_sample(model, kOldest, 0.001, rng, true_position);
    add_one_sample(model, kOldest - 1, 0.1, rng, otherwise);
    model.refit();
  }
  for (std::size_t h = 0; h < kLearntTimes; ++h) {
    const double apart = 0.5 * law(h).colwise().norm().maxCoeff();  // RMS difference of the two laws
    EXPECT_LT(model.at(kLearntAhead[h], kOldest - 1).variance.cwiseSqrt().maxCoeff(), 0.1 + 0.2 * apart)
        << kLearntAhead[h];
    EXPECT_LT(model.at(kLearntAhead[h], kOldest).variance.cwiseSqrt().maxCoeff(), 0.005) << kLearntAhead[h];
  }
}

TEST(LearntModel, DropsResidualsFromBeforeItHadEnoughSamples) {
  Rng rng(8);
  LearntModel model;
  // A crowd appears at once, as when a sensor is switched on: all residuals come before the first fit.
  for (int n = 0; n < 60; ++n) add_one_sample(model, kOldest, 0.01, rng, true_position);
  model.refit();
  const double unfitted = model.at(kLearntAhead.back(), kOldest).variance.maxCoeff();
  for (int n = 0; n < 10; ++n) {
    add_one_sample(model, kOldest, 0.01, rng, true_position);
    model.refit();
  }
  EXPECT_LT(model.at(kLearntAhead.back(), kOldest).variance.maxCoeff(), 0.02 * unfitted);
  EXPECT_EQ(model.horizon_s(kOldest), kLearntAhead.back());
}

TEST(LearntModel, IsUnusableForAGroupWithoutResiduals) {
  Rng rng(4);
  LearntModel model;
  add_samples(model, {.samples = 100, .first_group = kOldest}, rng);
  EXPECT_EQ(model.horizon_s(kOldest), kLearntAhead.back());
  EXPECT_EQ(model.horizon_s(0), 0.0);
}

TEST(LearntModel, EqualsItsFeatureFilterBeforeTheFirstSample) {
  Rng rng(5);
  BankFilter bank(Vec3(1, 2, 3), Vec3::Constant(0.01));
  for (int n = 1; n < 40; ++n) {
    bank.predict(bank_step(0.05));
    bank.update(Vec3(1 + 0.1 * n, 2 + std::sin(0.1 * n), 3), Vec3::Constant(0.01));
  }
  const LearntModel model;
  for (const double ahead : kLearntAhead) {
    const FilterPrediction by_filter = bank.of(kFeatureModel).at(output_rows(bank_step(ahead)[kFeatureModel]));
    const FilterPrediction by_learnt = learnt_prediction(model.at(ahead, kOldest), learnt_input(bank));
    EXPECT_LT((by_filter.position - by_learnt.position).norm(), 1e-9) << ahead;
  }
}

TEST(LearntModel, VelocityIsTheDerivativeOfPositionAndBothAreContinuous) {
  Rng rng(6);
  LearntModel model;
  add_samples(model, {.samples = 100}, rng);
  const LearntInput track = drawn(rng);
  const auto said = [&](double ahead) { return learnt_prediction(model.at(ahead, kOldest), track); };
  constexpr double kStep = 1e-5;
  for (double ahead = 0.0; ahead < 3.6; ahead += 0.0137) {
    const Vec3 slope = (said(ahead + kStep).position - said(ahead).position) / kStep;
    EXPECT_LT((slope - said(ahead).velocity).norm(), 1e-2) << ahead;
    EXPECT_LT((said(ahead + kStep).velocity - said(ahead).velocity).norm(), 1e-2) << ahead;
  }
  EXPECT_LT((said(0.0).position - track.position).norm(), 1e-12);
  const Features& x = track.features;
  EXPECT_LT((said(0.0).velocity - Vec3(x[0], x[kFeaturesPerAxis], x[2 * kFeaturesPerAxis])).norm(), 1e-9);
}

TEST(LearntGroup, GoesByAge) {
  EXPECT_FALSE(learnt_group(0.0));
  EXPECT_FALSE(learnt_group(std::nextafter(kLearntAges.front(), 0.0)));
  EXPECT_EQ(learnt_group(kLearntAges.front()), 0u);
  EXPECT_EQ(learnt_group(100.0), kOldest);
}

// Scores in which the learnt model predicted this group better than every other model.
ModelScores scored_well(std::size_t group) {
  ModelScores scores(-kMaxScoreGap);
  PerCandidate<double> score{};
  score[kLearnt] = 3.0;
  for (std::size_t h = 0; h < kScoredHorizons; ++h) {
    for (int n = 0; n < 100; ++n) scores.add(h, score, group, kPoolForgetting);
  }
  return scores;
}

TEST(LearntWeights, TheScoresOfOneGroupDoNotWeighInAnother) {
  const ModelScores pool = scored_well(kOldest), own;
  for (const double ahead : kScoredAhead) {
    EXPECT_GT(weights_at(model_weights(pool, own, kOldest, 3.0), ahead)[kLearnt], 0.9);
    EXPECT_EQ(weights_at(model_weights(pool, own, kOldest - 1, 3.0), ahead)[kLearnt], 0.0);
  }
}

TEST(LearntWeights, AModelThatDoesNotTakePartGetsNoScore) {
  ModelScores scores = scored_well(kOldest);
  PerCandidate<double> score{};
  score[kLearnt] = -100.0;
  const double before = scores.at(0, kOldest)[kLearnt];
  scores.add(0, score, std::nullopt, kPoolForgetting);
  scores.add(0, score, kOldest - 1, kPoolForgetting);
  EXPECT_EQ(scores.at(0, kOldest)[kLearnt], before);
  EXPECT_EQ(scores.at(0, kOldest - 1)[kLearnt], -kMaxScoreGap);
}

TEST(LearntWeights, FadeBeyondTheLearntHorizonAndAlwaysSumToOne) {
  const ModelScores pool = scored_well(kOldest), own;
  for (const double learnt_horizon_s : {0.0, 0.25, 0.375, 1.0, 1.5, 3.0}) {
    const HorizonWeights weights = model_weights(pool, own, kOldest, learnt_horizon_s);
    PerCandidate<double> before = weights_at(weights, 0.0);
    for (double ahead = 0.0; ahead < 5.0; ahead += 0.002) {
      const PerCandidate<double> at = weights_at(weights, ahead);
      double sum = 0.0, most = 0.0;
      for (std::size_t j = 0; j < at.size(); ++j) {
        sum += at[j];
        most = std::max(most, std::abs(at[j] - before[j]));
      }
      ASSERT_NEAR(sum, 1.0, 1e-12) << learnt_horizon_s << " s, " << ahead << " s";
      ASSERT_LT(most, 0.05) << learnt_horizon_s << " s, " << ahead << " s";
      if (learnt_horizon_s > 0.0 && ahead <= learnt_horizon_s) {
        ASSERT_GT(at[kLearnt], 0.9) << learnt_horizon_s << " s, " << ahead << " s";
      } else if (ahead >= kLearntFade * learnt_horizon_s) {
        ASSERT_EQ(at[kLearnt], 0.0) << learnt_horizon_s << " s, " << ahead << " s";
      }
      before = at;
    }
  }
}

// A tracker among obstacles that all follow one law.

struct Outcome {
  double mean_half = 0.0, rms = 0.0;  // at kAhead, m
  int covered = 0, intervals = 0;
  int learnt = 0;  // predictions of the learnt class
};

constexpr double kAhead = 1.0, kRate = 30.0, kNoise = 0.03, kApart = 30.0;

Outcome follow(const std::vector<Path>& paths, bool learns, double seconds) {
  TrackerConfig config;
  config.learns = learns;
  Tracker tracker(config);
  Rng rng(7);
  Outcome outcome;
  double squares = 0.0, half = 0.0;
  for (int frame = 0; frame < static_cast<int>(seconds * kRate); ++frame) {
    const double t = frame / kRate;
    std::vector<Detection> seen;
    for (const Path& path : paths) {
      if (rng.uniform() > 0.05) seen.push_back(testing::detection_of(path(t), kNoise, rng));
    }
    tracker.update(testing::observations_at(t, std::move(seen)));
    if (t < 0.6 * seconds || frame % 6 != 0) continue;
    for (const Track& track : tracker.predict(testing::at_seconds(t))) {
      const Vec3 start = track.motion.sample(track.motion.start).p;
      const auto which = static_cast<std::size_t>(std::lround(start.x() / kApart));
      const UTime then = track.motion.start + Duration::from_seconds(kAhead);
      ++outcome.intervals;
      outcome.covered += testing::covers(track, paths.at(which), kAhead) ? 1 : 0;
      squares += (track.motion.sample(then).p - paths.at(which)(t + kAhead)).squaredNorm();
      half += track.alpha[track.motion.locate(then).index].mean();
    }
    for (const TrackedObject& object : tracker.objects()) {
      outcome.learnt += tracker.assessment(object).of.motion == MotionKind::Learnt ? 1 : 0;
    }
  }
  outcome.rms = std::sqrt(squares / outcome.intervals);
  outcome.mean_half = half / outcome.intervals;
  return outcome;
}

// A tilted circle that goes up and down twice in a round, with a random size and phase.
std::vector<Path> going_round(int count) {
  Rng rng(8);
  std::vector<Path> paths;
  for (int k = 0; k < count; ++k) {
    const double size = rng.uniform(1.0, 2.0), phase = rng.uniform(0.0, 2.0 * kPi);
    const Vec3 centre(kApart * k, rng.uniform(-5.0, 5.0), 2.0);
    paths.emplace_back([=](double t) -> Vec3 {
      const double w = 2.0 * t + phase;
      return centre + size * Vec3(std::cos(w), std::sin(w) + 0.3 * std::cos(w), 0.4 * std::sin(2.0 * w));
    });
  }
  return paths;
}

TEST(LearntTracks, CirclingTracksArePredictedFarBetterAndCovered) {
  const std::vector<Path> paths = going_round(8);
  const Outcome given = follow(paths, false, 20.0), learnt = follow(paths, true, 20.0);
  EXPECT_EQ(given.learnt, 0);
  EXPECT_GT(learnt.learnt, learnt.intervals / 2);
  EXPECT_LT(learnt.rms, 0.3 * given.rms);
  EXPECT_LT(learnt.mean_half, 0.5 * given.mean_half);
  EXPECT_GT(testing::wilson(learnt.covered, learnt.intervals).high, 0.99);
}

TEST(LearntTracks, WithoutACommonLawTheBankPredictsAsWellAsBefore) {
  Rng rng(9);
  std::vector<Path> paths;
  for (int k = 0; k < 8; ++k) {
    paths.push_back(testing::random_path(rng, Vec3(kApart * k, 0, 2), Vec3(0.2, 0.7, 0.0), 0.15, 30.0));
  }
  const Outcome given = follow(paths, false, 20.0), learnt = follow(paths, true, 20.0);
  EXPECT_LT(learnt.rms, 1.1 * given.rms);
  EXPECT_GT(testing::wilson(learnt.covered, learnt.intervals).high, 0.99);
}

TEST(LearntTracks, AnUnseenTrackIsPredictedFromItsLastDetection) {
  const std::vector<Path> paths = going_round(8);
  TrackerConfig config;
  config.learns = true;
  Tracker tracker(config);
  Rng rng(10);
  constexpr double kHidden = 18.0;  // s: from here on the first one is not detected
  double worst = 0.0;
  int told = 0;
  for (int frame = 0; frame < static_cast<int>((kHidden + 1.0) * kRate); ++frame) {
    const double t = frame / kRate;
    std::vector<Detection> seen;
    for (std::size_t k = 0; k < paths.size(); ++k) {
      if (k > 0 || t < kHidden) seen.push_back(testing::detection_of(paths[k](t), kNoise, rng));
    }
    tracker.update(testing::observations_at(t, std::move(seen)));
    if (t < kHidden) continue;
    for (const Track& track : tracker.predict(testing::at_seconds(t))) {
      const Vec3 start = track.motion.sample(track.motion.start).p;
      if (start.x() > 0.5 * kApart) continue;
      worst = std::max(worst, (start - paths[0](t)).norm());
      ++told;
    }
  }
  EXPECT_GT(told, 20);
  EXPECT_LT(worst, 0.5);  // a circle of up to 2 m at 2 rad/s: constant velocity would be 4 m off after a second
}

}  // namespace
}  // namespace tern
