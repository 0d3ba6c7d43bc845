#include "predictor/tracking/model_weights.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tern {
namespace {

// Indices of pools.
constexpr std::size_t kSlow = 0, kFast = 1, kAll = 2;
// A track with this recent speed, m/s, is fast. The recent speed decays with kSpeedMemory, s.
constexpr double kFastSpeed = 2.0;
constexpr double kSpeedMemory = 3.0;
// The models' weights at this one of kScoredAhead decide the class of a track.
constexpr std::size_t kClassHorizon = 2;

}  // namespace

void TrackScores::add_speed(const DetectedTrack& track, UTime at, double gap_s) {
  recent_speed *= std::exp(-gap_s / kSpeedMemory);
  if (track.age_s(at) >= kYoungAge) recent_speed = std::max(recent_speed, track.bank->lead().velocity().norm());
}

ModelWeights::ModelWeights() {
  pools_.fill(ModelScores(-kMaxScoreGap));  // the learnt model begins far behind the others
}

HorizonWeights ModelWeights::of(std::size_t pool, const TrackScores& own, std::optional<std::size_t> group,
                                double learnt_horizon_s) const {
  return model_weights(pools_[pool], own.scores, group, learnt_horizon_s);
}

void ModelWeights::add(const ModelPredictions& predicted, std::size_t horizon, const Measurement& truth,
                       TrackScores& own) {
  PerCandidate<double> scores{};
  for (std::size_t j = 0; j < scores.size(); ++j) {
    const auto& [centre, variance] = predicted.at[horizon][j];
    for (int axis = 0; axis < 3; ++axis) {
      scores[j] += predictive_score(truth.z[axis] - centre[axis], variance[axis] + truth.r[axis]);
    }
  }
  // A model that did not take part gets no score (Y. Freund et al., "Using and combining predictors that specialize",
  // STOC 1997).
  const std::optional<std::size_t> group =
      kScoredAhead[horizon] <= predicted.learnt_horizon_s ? predicted.group : std::nullopt;
  own.scores.add(horizon, scores, group, kOwnForgetting);
  pools_[kAll].add(horizon, scores, group, kPoolForgetting);
  if (predicted.pool != kAll) pools_[predicted.pool].add(horizon, scores, group, kPoolForgetting);
}

std::size_t ModelWeights::pool_of(const DetectedTrack& track, UTime at, const TrackScores& own) {
  if (track.age_s(at) < kYoungAge) return kAll;
  return std::max(own.recent_speed, track.bank->lead().velocity().norm()) >= kFastSpeed ? kFast : kSlow;
}

TrackClass track_class(const DetectedTrack& track, UTime at, const HorizonWeights& weights) {
  const TrackAge age = track_age(track.detections, track.age_s(at));
  if (age == TrackAge::New) return kNewTrack;
  if (age == TrackAge::Young) return kYoungTrack;
  const PerCandidate<double> weight = weights_at(weights, kScoredAhead[kClassHorizon]);
  const auto sum = [first_of = weight.begin()](std::size_t first, std::size_t end) {
    return std::accumulate(first_of + static_cast<std::ptrdiff_t>(first), first_of + static_cast<std::ptrdiff_t>(end),
                           0.0);
  };
  const double steady = sum(0, kSteadyModels), calm = sum(kSteadyModels, kCalmModels);
  if (weight[kLearnt] > 0.5) return {age, MotionKind::Learnt};
  if (steady > 0.5) return {age, MotionKind::Steady};
  return {age, calm > 0.5 * (1.0 - steady) ? MotionKind::Calm : MotionKind::Lively};
}

}  // namespace tern
