#include "predictor/tracking/exchange.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>

namespace tern {
namespace {

// Another track cannot explain a prediction if its nearest detection is farther from the predicted centre than the
// track's own position by more than this on some axis, m.
constexpr double kFarApart = 2.0;

// Linear between the times of kEvaluatedAhead. @pre `ahead_s` is within them
MixturePrediction interpolated(const MixtureAhead& mixture, double ahead_s) {
  const auto next = std::lower_bound(kEvaluatedAhead.begin() + 1, kEvaluatedAhead.end() - 1, ahead_s);
  const auto k = static_cast<std::size_t>(next - kEvaluatedAhead.begin());
  const double u = (ahead_s - kEvaluatedAhead[k - 1]) / (kEvaluatedAhead[k] - kEvaluatedAhead[k - 1]);
  MixturePrediction between;
  between.centre = mixture[k - 1].centre + u * (mixture[k].centre - mixture[k - 1].centre);
  between.deviation = mixture[k - 1].deviation + u * (mixture[k].deviation - mixture[k - 1].deviation);
  return between;
}

// The margin with which a prediction of the other track, made at about the same time, covers the truth. Infinite if
// there is none.
double margin_of_other(const TrackRecord& other, UTime predicted_at, const Measurement& truth) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const auto stored = std::ranges::min_element(other.predictions, {}, [&](const StoredPrediction& prediction) {
    return std::abs((prediction.at - predicted_at).us);
  });
  if (stored == other.predictions.end() || std::abs((stored->at - predicted_at).seconds()) > kScorePeriod) return kNone;
  const double ahead_s = (truth.at - stored->at).seconds();
  if (ahead_s < kEvaluatedAhead.front() || ahead_s > kEvaluatedAhead.back()) return kNone;
  return margin_for(interpolated(stored->mixture, ahead_s), truth, ahead_s);
}

}  // namespace

Vec3 error_of(const MixturePrediction& mixture, const Measurement& truth) {
  return ((truth.z - mixture.centre).cwiseAbs2() - truth.r).cwiseMax(0.0).cwiseSqrt();
}

double margin_for(const MixturePrediction& mixture, const Measurement& truth, double ahead_s) {
  return covering_margin(error_of(mixture, truth), mixture.deviation, band_of(ahead_s), ahead_s);
}

void ExchangeSearch::begin(const PredictionLog& log, const std::vector<DetectedTrack>& seen) {
  places_.clear();
  for (const auto& [id, record] : log.records()) {
    Place& place = places_.emplace_back(Place{Box(), &record});
    for (const Measurement& detection : record.detections) place.box.extend(detection.z);
    const auto track = std::ranges::lower_bound(seen, id, {}, &DetectedTrack::id);
    if (track != seen.end() && track->id == id) place.box.extend(track->position);
  }
  tests_left_ = kMaxExchangeTests;
}

double ExchangeSearch::margin(const StoredPrediction& prediction, const Measurement& truth, const TrackRecord& own) {
  const MixturePrediction& mixture = prediction.mixture[prediction.next];
  const Vec3 far = (truth.z - mixture.centre).cwiseAbs().array() + kFarApart;
  const Box near(mixture.centre - far, mixture.centre + far);
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [box, record] : places_) {
    const TrackRecord& other = *record;
    if (!near.intersects(box) || &other == &own || other.detections.empty()) continue;
    const Vec3 apart = (nearest_in_time(other.detections, truth.at).z - mixture.centre).cwiseAbs();
    if ((apart.array() > far.array()).any()) continue;
    if (tests_left_-- <= 0) break;
    const std::optional<Measurement> there = smoothed_position(other.detections, truth.at);
    if (!there) continue;
    const double here = margin_for(mixture, *there, kEvaluatedAhead[prediction.next]);
    if (here >= least) continue;
    least = other.born > prediction.at ? here
                                       : std::min(least, std::max(here, margin_of_other(other, prediction.at, truth)));
  }
  return least;
}

}  // namespace tern
