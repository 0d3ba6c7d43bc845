// The predictions of all tracks that wait for later detections. Step 5 of docs/prediction.md.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "core/base/time.h"
#include "core/base/types.h"
#include "predictor/models/model_scores.h"
#include "predictor/tracking/detected_track.h"
#include "predictor/tracking/model_weights.h"
#include "predictor/tracking/scored_interval.h"
#include "predictor/tracking/smoothed_position.h"
#include "predictor/tracking/speed_record.h"

namespace tern {

/// The times after a prediction's start at which it is evaluated, s: two near its start, then two or three per band.
inline constexpr std::array<double, 12> kEvaluatedAhead{0.05, 0.125, 0.25, 0.375, 0.5, 0.75,
                                                        1.0,  1.5,   2.0,  2.5,   3.0, 4.5};
using MixtureAhead = std::array<MixturePrediction, kEvaluatedAhead.size()>;

/// One prediction: what each of its readers needs to compare it with the truth.
struct StoredPrediction {
  UTime at;
  Vec3 position = Vec3::Zero();  ///< as detected at `at`, W, m
  MixtureAhead mixture;          ///< the prediction
  ScoredInterval interval;       ///< its interval, for Calibration
  ModelPredictions models;       ///< each model's own prediction, for ModelWeights
  LearntInput learnt_input;      ///< the regressors of a sample, for LearntModel
  bool is_coarse = false;        ///< DetectedTrack::is_coarse at the start
  bool is_sighted = false;       ///< DetectedTrack::is_sighted
  std::size_t next = 0;          ///< the next one of kEvaluatedAhead
};

/// The stored predictions of one track, with the detections that they are compared with.
struct TrackRecord {
  UTime born, last_stored;
  TrackScores scores;
  std::optional<TrackSpeed> speed;      ///< over the last span (SpeedRecord::add_sighted)
  std::vector<Measurement> detections;  ///< ascending in time, as far back as smoothed_position() may need them
  std::deque<StoredPrediction> predictions;
  std::vector<UTime> due;  ///< the next evaluation of each prediction, kept apart because predictions are large
};

/// | event of a moving track                                  | effect                                      |
/// |----------------------------------------------------------|---------------------------------------------|
/// | detection 1, 2, 3, 5 and 8; kYoungAge; each kScorePeriod | a prediction is due to be stored            |
/// | kSmoothingSpan after one of kEvaluatedAhead              | a stored prediction is due to be evaluated  |
/// | no smoothed position, or the last time evaluated         | the prediction is finished                  |
/// | its filters are restarted                                | its stored predictions are forgotten        |
/// | the track is deleted                                     | its predictions are finished as they are    |
class PredictionLog {
 public:
  /// Notes a detection. @return the track's record, valid until it is forgotten
  TrackRecord& add_detection(const DetectedTrack& track, UTime at);
  /// True if a prediction of the track is to be stored.
  [[nodiscard]] static bool is_storing_due(const DetectedTrack& track, UTime at, const TrackRecord& record);
  /// Adds a prediction to the record. Its start is set, all else is left to the caller.
  static StoredPrediction& store(const DetectedTrack& track, UTime at, TrackRecord& record);
  /// Calls evaluate(prediction, truth) for each evaluation that is due, with the smoothed position at
  /// kEvaluatedAhead[prediction.next]. Finished predictions are removed; their scores are added to `finished`.
  template <class Evaluate>
  static void evaluate_due(TrackRecord& record, const Evaluate& evaluate, std::vector<ScoredPrediction>& finished);
  /// Forgets all other tracks; the scores of their predictions are added to `finished`.
  void keep_only(const std::set<std::int64_t>& tracks, std::vector<ScoredPrediction>& finished);

  /// Returns the record of a track, or nullptr. @pre the same filters, started at `born`
  [[nodiscard]] const TrackRecord* find(std::int64_t id, UTime born) const;
  [[nodiscard]] TrackRecord& at(std::int64_t id) { return records_.at(id); }
  [[nodiscard]] const std::map<std::int64_t, TrackRecord>& records() const { return records_; }

 private:
  std::map<std::int64_t, TrackRecord> records_;  // by id
};

inline UTime evaluation_time(UTime at, std::size_t k) { return at + Duration::from_seconds(kEvaluatedAhead[k]); }

template <class Evaluate>
void PredictionLog::evaluate_due(TrackRecord& record, const Evaluate& evaluate,
                                 std::vector<ScoredPrediction>& finished) {
  const UTime settled = record.detections.back().at - Duration::from_seconds(kSmoothingSpan);
  for (std::size_t i = 0; i < record.predictions.size();) {
    if (record.due[i] > settled) {
      ++i;
      continue;
    }
    StoredPrediction& prediction = record.predictions[i];
    const auto is_due = [&] {
      return prediction.next < kEvaluatedAhead.size() && evaluation_time(prediction.at, prediction.next) <= settled;
    };
    for (; is_due(); ++prediction.next) {
      const auto truth = smoothed_position(record.detections, evaluation_time(prediction.at, prediction.next));
      if (!truth) break;
      evaluate(prediction, *truth);
    }
    if (prediction.next < kEvaluatedAhead.size() && !is_due()) {
      record.due[i++] = evaluation_time(prediction.at, prediction.next);
      continue;
    }
    finished.push_back(prediction.interval.scored());
    record.predictions.erase(record.predictions.begin() + static_cast<std::ptrdiff_t>(i));
    record.due.erase(record.due.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

}  // namespace tern
