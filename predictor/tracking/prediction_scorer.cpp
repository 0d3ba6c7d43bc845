#include "predictor/tracking/prediction_scorer.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "predictor/models/axis_filter.h"

namespace tern {
namespace {

// Pools of model scores.
constexpr std::size_t kSlow = 0, kFast = 1, kAll = 2;
// A track with this recent speed, m/s, belongs to the pool kFast. The recent speed decays with kSpeedMemory, s.
constexpr double kFastSpeed = 2.0;
constexpr double kSpeedMemory = 3.0;
// The models' weights at this horizon (index of kScoredAhead) decide the class of a track.
constexpr std::size_t kClassHorizon = 2;
// Predictions of a new track are stored at these of its detections, and once when it is no longer young; then once in
// kScorePeriod.
constexpr std::array kFirstScored{1, 2, 3, 5, 8};

// Another track cannot explain a prediction if its nearest detection is farther from the predicted centre than the
// track's own position by more than this on some axis, m.
constexpr double kFarApart = 2.0;
constexpr bool is_evaluated(double ahead_s) {
  return std::find(kEvaluatedAhead.begin(), kEvaluatedAhead.end(), ahead_s) != kEvaluatedAhead.end();
}
static_assert(is_evaluated(kSpeedSpan) && std::all_of(kLearntAhead.begin(), kLearntAhead.end(), is_evaluated));

// The smoothed position at a time, with its variance; see kSmoothingSpan. The parabola needs four detections.
template <typename Measurement>
std::optional<Measurement> truth_at(const std::vector<Measurement>& measurements, UTime at) {
  std::size_t first = 0;
  while (first < measurements.size() && (at - measurements[first].at).seconds() > kSmoothingSpan) ++first;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  std::size_t last = first, before = 0;
  const auto row = [&](std::size_t k) -> Eigen::Vector3d {
    const double t = (measurements[k].at - at).seconds() / kSmoothingSpan;
    return {1.0, t, t * t};
  };
  for (; last < measurements.size() && (measurements[last].at - at).seconds() <= kSmoothingSpan; ++last) {
    normal += row(last) * row(last).transpose();
    before += measurements[last].at <= at ? 1U : 0U;
  }
  Measurement truth{at, Vec3::Zero(), Vec3::Zero()};
  if (last - first >= 4 && before > 0 && before < last - first) {
    const Eigen::Vector3d solved = normal.inverse().col(0);
    for (std::size_t k = first; k < last; ++k) {
      const double c = solved.dot(row(k));
      truth.z += c * measurements[k].z;
      truth.r += c * c * measurements[k].r;
    }
    return truth;
  }
  const auto after =
      std::find_if(measurements.begin(), measurements.end(), [&](const Measurement& s) { return s.at >= at; });
  if (after == measurements.begin() || after == measurements.end()) return std::nullopt;
  const Measurement& a = *(after - 1);
  const double gap = (after->at - a.at).seconds();
  if (gap > kMaxGap) return std::nullopt;
  const double u = (at - a.at).seconds() / gap;
  truth.z = (1.0 - u) * a.z + u * after->z;
  truth.r = (1.0 - u) * (1.0 - u) * a.r + u * u * after->r;
  return truth;
}

// The detection nearest in time.
template <typename Measurement>
const Measurement& nearest(const std::vector<Measurement>& measurements, UTime at) {
  const auto after = std::lower_bound(measurements.begin(), measurements.end() - 1, at,
                                      [](const Measurement& s, UTime t) { return s.at < t; });
  return after == measurements.begin() || after->at - at < at - (after - 1)->at ? *after : *(after - 1);
}

// The absolute error per axis, less what the variance of the smoothed position adds to its square.
template <typename Measurement>
Vec3 error_of(const MixturePrediction& mixture, const Measurement& truth) {
  return ((truth.z - mixture.centre).cwiseAbs2() - truth.r).cwiseMax(0.0).cwiseSqrt();
}

template <typename Measurement>
double margin_for(const MixturePrediction& mixture, const Measurement& truth, double ahead_s) {
  return covering_margin(error_of(mixture, truth), mixture.deviation, band_of(ahead_s), ahead_s);
}

// Linear between the times of kEvaluatedAhead. @pre `ahead_s` is within them
MixturePrediction interpolated(const std::array<MixturePrediction, kEvaluatedAhead.size()>& mixture, double ahead_s) {
  const auto next = std::lower_bound(kEvaluatedAhead.begin() + 1, kEvaluatedAhead.end() - 1, ahead_s);
  const auto k = static_cast<std::size_t>(next - kEvaluatedAhead.begin());
  const double u = (ahead_s - kEvaluatedAhead[k - 1]) / (kEvaluatedAhead[k] - kEvaluatedAhead[k - 1]);
  MixturePrediction between;
  between.centre = mixture[k - 1].centre + u * (mixture[k].centre - mixture[k - 1].centre);
  between.deviation = mixture[k - 1].deviation + u * (mixture[k].deviation - mixture[k - 1].deviation);
  return between;
}

UTime evaluated_at(UTime at, std::size_t k) { return at + Duration::from_seconds(kEvaluatedAhead[k]); }

}  // namespace

PredictionScorer::PredictionScorer(double confidence, bool learns) : learns_(learns), calibration_(confidence) {
  pools_.fill(ModelScores(-kMaxScoreGap));  // the learnt model begins far behind the others
  const BankStep none = bank_step(0.0);
  for (std::size_t k = 0; k < output_rows_.size(); ++k)
    output_rows_[k] = bank_output_rows(bank_step(kEvaluatedAhead[k]), none);
}

void PredictionScorer::update(UTime at, const std::vector<DetectedTrack>& seen, const std::set<std::int64_t>& tracks) {
  finished_.clear();
  note_places(seen);
  for (const DetectedTrack& track : seen) {
    History& history = histories_[track.id];
    if (history.measurements.empty() || history.born != track.born) {
      history = History{};
      history.born = track.born;
    }
    add_measurement(track, at, history);
    evaluate_due(track.id, history);
  }
  calibration_.set_scene_speed(scene_speed());
  calibration_.refresh();
  if (learns_) refit_learnt_model();
  for (const DetectedTrack& track : seen) {
    if (!track.is_stationary) store_prediction(track, at, histories_[track.id]);
  }
  std::erase_if(histories_, [&](const auto& entry) {
    const auto& [id, history] = entry;
    if (tracks.contains(id)) return false;
    for (const StoredPrediction& prediction : history.predictions) finished_.push_back(prediction.result);
    return true;
  });
}

void PredictionScorer::note_places(const std::vector<DetectedTrack>& seen) {
  places_.clear();
  for (const auto& [id, history] : histories_) {
    Place& place = places_.emplace_back(Place{Box(), &history});
    for (const Measurement& measurement : history.measurements) place.box.extend(measurement.z);
    const auto track = std::ranges::lower_bound(seen, id, {}, &DetectedTrack::id);
    if (track != seen.end() && track->id == id) place.box.extend(track->position);
  }
  exchange_tests_left_ = kMaxExchangeTests;
}

void PredictionScorer::refit_learnt_model() {
  learnt_.refit();
  for (std::size_t group = 0; group < kLearntGroups; ++group) {
    for (std::size_t k = 0; k < kEvaluatedAhead.size(); ++k) {
      learnt_coefficients_[group][k] = learnt_.at(kEvaluatedAhead[k], group);
    }
  }
}

void PredictionScorer::add_measurement(const DetectedTrack& track, UTime at, History& history) {
  if (!history.measurements.empty()) {
    history.recent_speed *= std::exp(-(at - history.measurements.back().at).seconds() / kSpeedMemory);
  }
  if ((at - track.born).seconds() >= kYoungAge) {
    history.recent_speed = std::max(history.recent_speed, track.bank->lead().velocity().norm());
  }
  history.measurements.push_back({at, track.position, track.variance.cwiseMax(kMinVariance)});
  std::erase_if(history.measurements,
                [&](const Measurement& s) { return (at - s.at).seconds() > 2.0 * kSmoothingSpan + kMaxGap; });
}

void PredictionScorer::store_prediction(const DetectedTrack& track, UTime at, History& history) const {
  const bool first = std::find(kFirstScored.begin(), kFirstScored.end(), track.detections) != kFirstScored.end();
  const bool grew_up =
      (history.last_predicted - track.born).seconds() < kYoungAge && (at - track.born).seconds() >= kYoungAge;
  const bool is_due = history.predictions.empty() || (at - history.last_predicted).seconds() >= kScorePeriod;
  if (!first && !grew_up && !is_due) return;
  history.last_predicted = at;
  StoredPrediction& prediction = history.predictions.emplace_back();
  history.due.push_back(evaluated_at(at, 0));
  prediction.at = at;
  prediction.position = track.position;
  prediction.scene_speed = calibration_.scene_speed();
  prediction.pool = pool_of(track, at, history.recent_speed);
  prediction.score = -kModelSigmas;
  prediction.half_width.fill(Vec3::Zero());
  if (learns_) {
    prediction.learnt_input = learnt_input(*track.bank);
    prediction.group = learnt_group((at - track.born).seconds());
  }
  prediction.learnt_horizon_s = learnt_horizon_s(prediction.group);
  const HorizonWeights all =
      model_weights(pools_[prediction.pool], history.own, prediction.group, prediction.learnt_horizon_s);
  prediction.result.kind = class_of(track, at, all);
  prediction.margins = calibration_.margins(prediction.result.kind);
  for (std::size_t k = 0; k < output_rows_.size(); ++k) {
    FilterPrediction learnt{prediction.position, Vec3::Zero(), Vec3::Zero()};  // without a group its weight is 0
    if (prediction.group)
      learnt = learnt_prediction(learnt_coefficients_[*prediction.group][k], prediction.learnt_input);
    prediction.mixture[k] =
        mixture_prediction(*track.bank, output_rows_[k], learnt, weights_at(all, kEvaluatedAhead[k]));
    const auto scored = std::find(kScoredAhead.begin(), kScoredAhead.end(), kEvaluatedAhead[k]);
    if (scored == kScoredAhead.end()) continue;
    PerCandidate<ModelPrediction>& by_model =
        prediction.by_model[static_cast<std::size_t>(scored - kScoredAhead.begin())];
    for (std::size_t j = 0; j < kModels; ++j) {
      const FilterPrediction ahead = track.bank->of(j).at(output_rows_[k][j]);
      by_model[j] = {ahead.position, ahead.variance};
    }
    by_model[kLearnt] = {learnt.position, learnt.variance};
  }
}

void PredictionScorer::evaluate_due(std::int64_t id, History& history) {
  const UTime settled = history.measurements.back().at - Duration::from_seconds(kSmoothingSpan);
  for (std::size_t i = 0; i < history.predictions.size();) {
    if (history.due[i] > settled) {
      ++i;
      continue;
    }
    StoredPrediction& prediction = history.predictions[i];
    while (prediction.next < kEvaluatedAhead.size() && evaluated_at(prediction.at, prediction.next) <= settled) {
      const std::optional<Measurement> truth =
          truth_at(history.measurements, evaluated_at(prediction.at, prediction.next));
      if (!truth) break;
      evaluate(prediction, *truth, id, history);
      ++prediction.next;
    }
    // Finished: evaluated to its end, or no position is known.
    const bool is_over =
        prediction.next == kEvaluatedAhead.size() || evaluated_at(prediction.at, prediction.next) <= settled;
    if (!is_over) {
      history.due[i++] = evaluated_at(prediction.at, prediction.next);
      continue;
    }
    finished_.push_back(prediction.result);
    history.predictions.erase(history.predictions.begin() + static_cast<std::ptrdiff_t>(i));
    history.due.erase(history.due.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

void PredictionScorer::evaluate(StoredPrediction& prediction, const Measurement& truth, std::int64_t id,
                                History& history) {
  const std::size_t k = prediction.next, band = band_of(kEvaluatedAhead[k]);
  const MixturePrediction& mixture = prediction.mixture[k];
  if (kEvaluatedAhead[k] == kSpeedSpan) add_speed((truth.z - prediction.position) / kSpeedSpan, id);
  const double own = margin_for(mixture, truth, kEvaluatedAhead[k]);
  const double score = own > 0.0 ? std::min(own, exchanged_margin(prediction, truth, history)) : own;
  prediction.score = std::max(prediction.score, score);
  if (score == own) add_sample(prediction, truth);
  const Vec3 error = error_of(mixture, truth);
  for (std::size_t level = 0; level < prediction.margins.size(); ++level) {
    Vec3& half_width = prediction.half_width[level];
    half_width =
        half_width.cwiseMax(interval_half_width(mixture.deviation, prediction.margins[level], kEvaluatedAhead[k]));
    const bool is_outside = (error.array() > half_width.array()).any() && score > prediction.margins[level][band];
    prediction.missed[level] = prediction.missed[level] || is_outside;
  }
  if (kEvaluatedAhead[k] < kBandEnds[band]) return;
  const auto final_score = static_cast<float>(prediction.score);
  calibration_.add(prediction.result.kind, band, final_score, prediction.missed, prediction.scene_speed);
  prediction.result.scores[band] = final_score;
  prediction.result.bands = band + 1;
  prediction.score = -kModelSigmas;

  const auto scored = std::find(kScoredAhead.begin(), kScoredAhead.end(), kEvaluatedAhead[k]);
  if (scored == kScoredAhead.end() || score < own)
    return;  // detections exchanged: the errors are those of another track
  score_models(prediction, truth, idx(scored - kScoredAhead.begin()), history);
}

void PredictionScorer::score_models(const StoredPrediction& prediction, const Measurement& truth, std::size_t h,
                                    History& history) {
  PerCandidate<double> scores{};
  for (std::size_t j = 0; j < scores.size(); ++j) {
    const ModelPrediction& model = prediction.by_model[h][j];
    for (int i = 0; i < 3; ++i) {
      scores[j] += predictive_score(truth.z[i] - model.centre[i], model.variance[i] + truth.r[i]);
    }
  }
  // A model that did not take part gets no score (Y. Freund et al., "Using and combining predictors that specialize",
  // STOC 1997).
  const std::optional<std::size_t> group =
      kScoredAhead[h] <= prediction.learnt_horizon_s ? prediction.group : std::nullopt;
  history.own.add(h, scores, group, kOwnForgetting);
  pools_[kAll].add(h, scores, group, kPoolForgetting);
  if (prediction.pool != kAll) pools_[prediction.pool].add(h, scores, group, kPoolForgetting);
}

void PredictionScorer::add_sample(const StoredPrediction& prediction, const Measurement& truth) {
  const auto at = std::find(kLearntAhead.begin(), kLearntAhead.end(), kEvaluatedAhead[prediction.next]);
  if (!prediction.group || at == kLearntAhead.end()) return;
  learnt_.add_sample(idx(at - kLearntAhead.begin()), *prediction.group, prediction.learnt_input, truth.z, truth.r,
                     score_weight(*at));
}

void PredictionScorer::add_speed(const Vec3& velocity, std::int64_t id) {
  max_axis_speed_ = std::max(max_axis_speed_, velocity.cwiseAbs().maxCoeff());
  max_speed_ = std::max(max_speed_, velocity.norm());
  if (velocity.norm() > kMinMovingSpeed && movers_.size() < kMinMovers) movers_.insert(id);
}

SceneSpeed PredictionScorer::scene_speed() const {
  return movers_.size() >= kMinMovers && max_speed_ < kSlowSpeed ? SceneSpeed::Slow : SceneSpeed::Any;
}

double PredictionScorer::exchanged_margin(const StoredPrediction& prediction, const Measurement& truth,
                                          const History& own) {
  const Vec3& centre = prediction.mixture[prediction.next].centre;
  const Vec3 far = (truth.z - centre).cwiseAbs().array() + kFarApart;
  const Box near(centre - far, centre + far);
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [box, history] : places_) {
    const History& other = *history;
    if (!near.intersects(box) || &other == &own || other.measurements.empty()) continue;
    const Vec3 apart = (nearest(other.measurements, truth.at).z - centre).cwiseAbs();
    if ((apart.array() > far.array()).any()) continue;
    if (exchange_tests_left_-- <= 0) break;
    const std::optional<Measurement> there = truth_at(other.measurements, truth.at);
    if (!there) continue;
    const double here = margin_for(prediction.mixture[prediction.next], *there, kEvaluatedAhead[prediction.next]);
    if (here >= least) continue;
    if (other.born > prediction.at) {
      least = here;
      continue;
    }
    const auto is_nearer = [&](const StoredPrediction& a, const StoredPrediction& b) {
      return std::abs((a.at - prediction.at).us) < std::abs((b.at - prediction.at).us);
    };
    const auto stored = std::min_element(other.predictions.begin(), other.predictions.end(), is_nearer);
    if (stored == other.predictions.end() || std::abs((stored->at - prediction.at).seconds()) > kScorePeriod) continue;
    const double ahead_s = (truth.at - stored->at).seconds();
    if (ahead_s < kEvaluatedAhead.front() || ahead_s > kEvaluatedAhead.back()) continue;  // beyond its evaluation times
    least = std::min(least, std::max(here, margin_for(interpolated(stored->mixture, ahead_s), truth, ahead_s)));
  }
  return least;
}

const PredictionScorer::History* PredictionScorer::find_history(std::int64_t id, UTime born) const {
  const auto found = histories_.find(id);
  return found == histories_.end() || found->second.born != born ? nullptr : &found->second;
}

std::size_t PredictionScorer::pool_of(const DetectedTrack& track, UTime at, double recent_speed) {
  if ((at - track.born).seconds() < kYoungAge) return kAll;
  return std::max(recent_speed, track.bank->lead().velocity().norm()) >= kFastSpeed ? kFast : kSlow;
}

PredictionScorer::Assessment PredictionScorer::assessment(const DetectedTrack& track, UTime last_seen) const {
  const History* history = find_history(track.id, track.born);
  const ModelScores own = history == nullptr ? ModelScores{} : history->own;
  const double recent_speed = history == nullptr ? 0.0 : history->recent_speed;
  Assessment assessment;
  assessment.group = learnt_group((last_seen - track.born).seconds());
  assessment.weights = model_weights(pools_[pool_of(track, last_seen, recent_speed)], own, assessment.group,
                                     learnt_horizon_s(assessment.group));
  assessment.kind = class_of(track, last_seen, assessment.weights);
  return assessment;
}

TrackClass PredictionScorer::class_of(const DetectedTrack& track, UTime now, const HorizonWeights& weights) {
  if (track.detections <= 1) return TrackClass::New;
  const double age = (now - track.born).seconds();
  if (age < kYoungAge) return TrackClass::Young;
  const PerCandidate<double> at = weights_at(weights, kScoredAhead[kClassHorizon]);
  const auto weight = [first_of = at.begin()](std::size_t first, std::size_t end) {
    return std::accumulate(first_of + static_cast<std::ptrdiff_t>(first), first_of + static_cast<std::ptrdiff_t>(end),
                           0.0);
  };
  const double steady = weight(0, kSteadyModels), calm = weight(kSteadyModels, kCalmModels);
  const bool old = age >= kGrownAge;
  if (at[kLearnt] > 0.5) return TrackClass::Learnt;
  if (steady > 0.5) return old ? TrackClass::SteadyOld : TrackClass::SteadyGrown;
  if (calm > 0.5 * (1.0 - steady)) return old ? TrackClass::CalmOld : TrackClass::CalmGrown;
  return old ? TrackClass::LivelyOld : TrackClass::LivelyGrown;
}

}  // namespace tern
