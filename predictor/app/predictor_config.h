// The section `predictor:` of a scenario file.
#pragma once

#include "predictor/tracking/tracker.h"
#include "runtime/config.h"

namespace tern {

enum class PredictorModel { Declared, Detections, Both };

struct PredictorConfig {
  PredictorModel model = PredictorModel::Both;
  double rate_hz = 20.0;
  TrackerConfig tracker;  ///< its prediction.horizon serves the declared model too

  /// Between published sets.
  [[nodiscard]] Duration period() const { return Duration::from_seconds(1.0 / rate_hz); }

  template <typename V>
  void visit(V& v) {
    PredictionSpec& prediction = tracker.prediction;
    v("model", model,
      KnobWords<PredictorModel>{{"declared", PredictorModel::Declared},
                                {"detections", PredictorModel::Detections},
                                {"both", PredictorModel::Both}},
      "`declared`: declared motions alone, detections are ignored. `detections`: detections alone. `both`: "
      "declared motions, and estimates of what they do not explain");
    v("rate_hz", rate_hz, Range{1.0, 100.0}, "sets per second");
    v("horizon_s", prediction.horizon, Range{0.1, 30.0}, "how far predictions reach, s");
    v("piece_s", prediction.piece, Range{0.05, 5.0}, "length of the first pieces, s; at most 460 over the horizon");
    v("piece_growth", prediction.piece_growth, Range{0.0, 1.0}, "a piece is at least so much of the time before it");
    v("confidence", prediction.confidence, Range{0.5, 0.999999},
      "probability that a track keeps its α over all its pieces");
    v("max_speed", prediction.max_speed, Range::positive(1e3),
      "what is new or starts is believed to be no faster, m/s per axis, unless something faster was seen");
    v("confirm_hits", tracker.confirm_hits, Range{1, 32}, "a track is confirmed by so many detections …");
    v("confirm_window", tracker.confirm_window, Range{1, 32},
      "… in its first so many frames of the sensor that saw it last (others' frames count when they see it too)");
    v("coast_s", tracker.coast, Range{0.0, 60.0}, "how long a confirmed track outlives its last detection, s");
    v("remember_rest_s", tracker.remember_rest, Range{0.0, 1e6},
      "how long what rests outlives its last detection while it is out of the sensor's range, and anything while the "
      "sensor that saw it is silent and others are not, s");
    v("resting_after_s", tracker.resting_after, Range{0.1, 1e6},
      "how long something must rest before it is predicted at rest, s; very large: never");
  }
};

/// Reads and finishes the section. @throws ConfigError.
PredictorConfig read_predictor_config(ConfigSection section);

}  // namespace tern
