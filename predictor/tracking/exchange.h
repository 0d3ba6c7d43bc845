// Whether two tracks that passed closely may have exchanged their detections.
#pragma once

#include <vector>

#include "core/base/types.h"
#include "predictor/tracking/prediction_log.h"

namespace tern {

/// The most pairs of tracks that are tested per observation set. A flood of false detections holds more; there a track
/// that was perhaps exchanged counts as a miss, which makes intervals wider.
inline constexpr int kMaxExchangeTests = 20'000;

/// Finds tracks that may have been exchanged, among all tracks of a log.
class ExchangeSearch {
 public:
  /// Begins with a new observation set. @param seen  the tracks that it detected, ascending by id
  void begin(const PredictionLog& log, const std::vector<DetectedTrack>& seen);

  /// Returns the margin with which two predictions together cover two tracks whose detections were exchanged: each
  /// track is where the other one was predicted. For a track that did not exist at prediction.at, only the first
  /// prediction must cover it. In both cases each box still contains an obstacle, so a plan that avoids both boxes is
  /// safe. Infinite if no other track fits. O(tracks).
  /// @param truth  where the track `own` was at kEvaluatedAhead[prediction.next]
  double margin(const StoredPrediction& prediction, const Measurement& truth, const TrackRecord& own);

 private:
  // A box that contains all detections of a track.
  struct Place {
    Box box;
    const TrackRecord* record;
  };
  std::vector<Place> places_;
  int tests_left_ = 0;
};

/// Returns the absolute error per axis, less what the variance of the smoothed position adds to its square.
Vec3 error_of(const MixturePrediction& mixture, const Measurement& truth);
/// Returns the least margin with which the interval covers the truth.
double margin_for(const MixturePrediction& mixture, const Measurement& truth, double ahead_s);

}  // namespace tern
