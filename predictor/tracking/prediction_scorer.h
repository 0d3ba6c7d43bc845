// Scores the tracker's own predictions against later detections. The scores weigh the motion models and set the
// margins. The steps and their equations: docs/prediction.md.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <set>
#include <vector>

#include "core/base/time.h"
#include "core/world/track_class.h"
#include "predictor/models/learnt_model.h"
#include "predictor/models/model_scores.h"
#include "predictor/tracking/calibration.h"
#include "predictor/tracking/detected_track.h"
#include "predictor/tracking/exchange.h"
#include "predictor/tracking/model_weights.h"
#include "predictor/tracking/prediction_log.h"
#include "predictor/tracking/speed_record.h"

namespace tern {

/// Stores predictions of all tracks in a PredictionLog and compares each with the smoothed position at each of
/// kEvaluatedAhead. Every comparison feeds four estimators:
///
/// | estimator    | receives                                                          | gives                        |
/// |--------------|-------------------------------------------------------------------|------------------------------|
/// | SpeedRecord  | the distance over kSpeedSpan                                      | the scene's speed            |
/// | Calibration  | the error; at the end of a band its score, and whether it missed  | margins                      |
/// | LearntModel  | at each of kLearntAhead the position, with the track's features   | a motion model of the flight |
/// | ModelWeights | at each of kScoredAhead the errors of all models                  | weights of the models        |
///
/// Coarse tracks have a Calibration of their own.
///
/// If two tracks may have exchanged their detections (exchange.h), the last two receive nothing, because the error
/// is that of another track.
///
/// A value: the same tracks in the same order give the same weights and margins.
class PredictionScorer {
 public:
  /// @param learns  whether the learnt model takes part (learnt_model.h)
  explicit PredictionScorer(double confidence, bool learns = true);

  /// Takes one observation set. @pre sets come in order of time
  /// @param seen  the tracks that were detected at `at`, ascending by id
  /// @param tracks  the ids of all existing tracks; all others are forgotten
  void update(UTime at, const std::vector<DetectedTrack>& seen, const std::set<std::int64_t>& tracks);

  /// How a track is to be predicted.
  struct Assessment {
    HorizonWeights weights;
    TrackClass of;
    std::optional<std::size_t> group;  ///< of the learnt model; present wherever that model has a weight
  };
  /// Returns the weights of the models for a track, and its class. A track without scores has the weights of its pool.
  /// @param track  in its present state, which may be newer than the last update()
  [[nodiscard]] Assessment assessment(const DetectedTrack& track, UTime last_seen) const;
  /// The margins of coarse tracks, or of all others.
  [[nodiscard]] const Calibration& calibration(bool is_coarse = false) const {
    return is_coarse ? coarse_calibration_ : calibration_;
  }
  [[nodiscard]] const LearntModel& learnt() const { return learnt_; }
  [[nodiscard]] const SpeedRecord& speeds() const { return speeds_; }
  /// The predictions that the last update() finished.
  [[nodiscard]] const std::vector<ScoredPrediction>& finished() const { return finished_; }

 private:
  void evaluate(StoredPrediction& prediction, const Measurement& truth, std::int64_t id, TrackRecord& record);
  void store_prediction(const DetectedTrack& track, UTime at, TrackRecord& record);
  void refit_learnt_model();
  [[nodiscard]] Assessment assessment(const DetectedTrack& track, UTime at, const TrackScores& scores) const;

  bool learns_;
  PredictionLog log_;
  ExchangeSearch exchange_;
  SpeedRecord speeds_;
  Calibration calibration_, coarse_calibration_;
  LearntModel learnt_;
  ModelWeights weights_;
  std::vector<ScoredPrediction> finished_;
  std::array<BankOutputRows, kEvaluatedAhead.size()> output_rows_;
  std::array<std::array<LearntCoefficients, kEvaluatedAhead.size()>, kLearntGroups> learnt_coefficients_;
};

}  // namespace tern
