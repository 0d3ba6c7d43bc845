// The section `predictor:` of a scenario file.
#pragma once

#include "predictor/tracking/tracker.h"
#include "runtime/config.h"

namespace tern {

enum class PredictorModel { Declared, Detections, Both };

struct PredictorConfig {
  PredictorModel model = PredictorModel::Both;
  double rate_hz = 20.0;
  TrackerConfig tracker;  ///< its prediction.horizon also cuts declared tracks

  /// The time between two published sets.
  [[nodiscard]] Duration period() const { return Duration::from_seconds(1.0 / rate_hz); }

  template <typename V>
  void visit(V& v) {
    PredictionSpec& prediction = tracker.prediction;
    v("model", model,
      KnobWords<PredictorModel>{{"declared", PredictorModel::Declared},
                                {"detections", PredictorModel::Detections},
                                {"both", PredictorModel::Both}},
      "source of tracks. `declared`: declared motions. `detections`: detections. `both`: declared motions, and "
      "detections that they do not explain");
    v("rate_hz", rate_hz, Range{1.0, 100.0}, "sets of predictions per second");
    v("horizon_s", prediction.horizon, Range{0.1, 30.0}, "how far ahead predictions reach, s");
    v("piece_s", prediction.piece, Range{0.05, 5.0},
      "length of the first pieces, s; at most 460 pieces over the horizon");
    v("piece_growth", prediction.piece_growth, Range{0.0, 1.0},
      "least length of a piece, as a share of the time from the start of the prediction to the piece");
    v("confidence", prediction.confidence, Range{0.5, 0.999999},
      "probability that the prediction interval covers a track over the whole horizon");
    v("max_speed", prediction.max_speed, Range::positive(1e3),
      "largest speed of a new or starting track, m/s per axis; a faster speed that was seen replaces it");
    v("confirm_hits", tracker.confirm_hits, Range{1, 32},
      "number of detections within `confirm_window` that confirm a track");
    v("confirm_window", tracker.confirm_window, Range{1, 32},
      "number of frames within which a new track must be confirmed. Only frames count that detect the track, or come "
      "from the sensor that detected it last");
    v("coast_s", tracker.coast, Range{0.0, 60.0},
      "how long a confirmed track is predicted after its last detection, s");
    v("remember_rest_s", tracker.remember_rest, Range{0.0, 1e6},
      "the same as `coast_s`, for a confirmed track that is stationary and out of the sensor's range, or whose sensor "
      "is silent, s");
    v("resting_after_s", tracker.resting_after, Range{0.1, 1e6},
      "how long a track must be consistent with rest before it is predicted at rest, s; with 1000000 never");
  }
};

/// Reads and checks the section. @throws ConfigError
PredictorConfig read_predictor_config(ConfigSection section);

}  // namespace tern
