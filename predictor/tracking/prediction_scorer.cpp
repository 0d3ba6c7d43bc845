#include "predictor/tracking/prediction_scorer.h"

#include <algorithm>
#include <cstddef>

namespace tern {
namespace {

// The index of a time in a list of times; its size if the list has no such time.
template <std::size_t N>
constexpr std::size_t index_in(const std::array<double, N>& times, double ahead_s) {
  return idx(std::find(times.begin(), times.end(), ahead_s) - times.begin());
}
constexpr bool is_evaluated(double ahead_s) { return index_in(kEvaluatedAhead, ahead_s) < kEvaluatedAhead.size(); }
static_assert(is_evaluated(kSpeedSpan) && std::all_of(kLearntAhead.begin(), kLearntAhead.end(), is_evaluated) &&
              std::all_of(kCoverageHorizons.begin(), kCoverageHorizons.end(), is_evaluated));

}  // namespace

PredictionScorer::PredictionScorer(double confidence, bool learns)
    : learns_(learns), calibration_(confidence), coarse_calibration_(confidence) {
  const BankStep none = bank_step(0.0);
  for (std::size_t k = 0; k < output_rows_.size(); ++k)
    output_rows_[k] = bank_output_rows(bank_step(kEvaluatedAhead[k]), none);
}

void PredictionScorer::update(UTime at, const std::vector<DetectedTrack>& seen, const std::set<std::int64_t>& tracks) {
  finished_.clear();
  exchange_.begin(log_, seen);
  for (const DetectedTrack& track : seen) {
    TrackRecord& record = log_.add_detection(track, at);
    PredictionLog::evaluate_due(
        record,
        [&](StoredPrediction& prediction, const Measurement& truth) { evaluate(prediction, truth, track.id, record); },
        finished_);
  }
  for (Calibration* calibration : {&calibration_, &coarse_calibration_}) {
    calibration->set_scene_speed(speeds_.scene_speed());
    calibration->refresh();
  }
  if (learns_) refit_learnt_model();
  for (const DetectedTrack& track : seen) {
    TrackRecord& record = log_.at(track.id);
    if (!track.is_stationary && PredictionLog::is_storing_due(track, at, record)) store_prediction(track, at, record);
  }
  log_.keep_only(tracks, finished_);
}

void PredictionScorer::evaluate(StoredPrediction& prediction, const Measurement& truth, std::int64_t id,
                                TrackRecord& record) {
  const double ahead_s = kEvaluatedAhead[prediction.next];
  const MixturePrediction& mixture = prediction.mixture[prediction.next];
  if (ahead_s == kSpeedSpan) {
    const Vec3 velocity = (truth.z - prediction.position) / kSpeedSpan;
    prediction.is_sighted ? speeds_.add_sighted({prediction.at, velocity}, id, record.speed)
                          : speeds_.add(velocity, id);
  }

  const double own = margin_for(mixture, truth, ahead_s);
  const double score = own > 0.0 ? std::min(own, exchange_.margin(prediction, truth, record)) : own;
  prediction.interval.add(error_of(mixture, truth), mixture.deviation, score, ahead_s);
  const std::size_t band = index_in(kCoverageHorizons, ahead_s);
  if (band < kBands) prediction.interval.end_band(band, prediction.is_coarse ? coarse_calibration_ : calibration_);

  const bool is_exchanged = score < own;
  if (is_exchanged) return;
  const std::size_t learnt_at = index_in(kLearntAhead, ahead_s);
  if (prediction.models.group && learnt_at < kLearntTimes) {
    learnt_.add_sample(learnt_at, *prediction.models.group, prediction.learnt_input, truth.z, truth.r,
                       score_weight(ahead_s));
  }
  const std::size_t scored_at = index_in(kScoredAhead, ahead_s);
  if (scored_at < kScoredHorizons) weights_.add(prediction.models, scored_at, truth, record.scores);
}

void PredictionScorer::refit_learnt_model() {
  learnt_.refit();
  for (std::size_t group = 0; group < kLearntGroups; ++group) {
    for (std::size_t k = 0; k < kEvaluatedAhead.size(); ++k) {
      learnt_coefficients_[group][k] = learnt_.at(kEvaluatedAhead[k], group);
    }
  }
}

void PredictionScorer::store_prediction(const DetectedTrack& track, UTime at, TrackRecord& record) {
  const Assessment assessed = assessment(track, at, record.scores);
  StoredPrediction& prediction = PredictionLog::store(track, at, record);
  prediction.is_coarse = track.is_coarse;
  prediction.is_sighted = track.is_sighted;
  prediction.interval = ScoredInterval(assessed.of, calibration(track.is_coarse));
  prediction.models.pool = ModelWeights::pool_of(track, at, record.scores);
  prediction.models.learnt_horizon_s = assessed.weights.learnt_horizon_s;
  if (learns_) {
    prediction.learnt_input = learnt_input(*track.bank);
    prediction.models.group = assessed.group;
  }
  for (std::size_t k = 0; k < kEvaluatedAhead.size(); ++k) {
    FilterPrediction learnt{prediction.position, Vec3::Zero(), Vec3::Zero()};  // without a group its weight is 0
    if (prediction.models.group)
      learnt = learnt_prediction(learnt_coefficients_[*prediction.models.group][k], prediction.learnt_input);
    prediction.mixture[k] =
        mixture_prediction(*track.bank, output_rows_[k], learnt, weights_at(assessed.weights, kEvaluatedAhead[k]));
    const std::size_t scored_at = index_in(kScoredAhead, kEvaluatedAhead[k]);
    if (scored_at == kScoredHorizons) continue;
    auto& by_model = prediction.models.at[scored_at];
    for (std::size_t j = 0; j < kModels; ++j) {
      const FilterPrediction ahead = track.bank->of(j).at(output_rows_[k][j]);
      by_model[j] = {ahead.position, ahead.variance};
    }
    by_model[kLearnt] = {learnt.position, learnt.variance};
  }
}

PredictionScorer::Assessment PredictionScorer::assessment(const DetectedTrack& track, UTime last_seen) const {
  const TrackRecord* record = log_.find(track.id, track.born);
  return assessment(track, last_seen, record == nullptr ? TrackScores{} : record->scores);
}

PredictionScorer::Assessment PredictionScorer::assessment(const DetectedTrack& track, UTime at,
                                                          const TrackScores& scores) const {
  Assessment assessment;
  assessment.group = learnt_group(track.age_s(at));
  const double learnt_horizon_s = learns_ && assessment.group ? learnt_.horizon_s(*assessment.group) : 0.0;
  assessment.weights =
      weights_.of(ModelWeights::pool_of(track, at, scores), scores, assessment.group, learnt_horizon_s);
  assessment.of = track_class(track, at, assessment.weights);
  return assessment;
}

}  // namespace tern
