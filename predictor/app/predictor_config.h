// The section `predictor:` of a scenario file.
#pragma once

#include "predictor/tracking/tracker.h"
#include "runtime/config.h"

namespace tern {

enum class PredictorModel { Declared, ConstantVelocity, Both };

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
                                {"constant_velocity", PredictorModel::ConstantVelocity},
                                {"both", PredictorModel::Both}},
      "`declared`: declared motions alone, detections are ignored. `constant_velocity`: detections alone. `both`: "
      "declared motions, and estimates of what they do not explain");
    v("rate_hz", rate_hz, Range{1.0, 100.0}, "sets per second");
    v("horizon_s", prediction.horizon, Range{0.1, 30.0}, "how far predictions reach, s");
    v("piece_s", prediction.piece, Range{0.05, 5.0}, "length of the first pieces, s; at most 460 over the horizon");
    v("piece_growth", prediction.piece_growth, Range{0.0, 1.0}, "a piece is at least so much of the time before it");
    v("confidence", prediction.confidence, Range{0.5, 0.999999},
      "probability that a track keeps its α over all its pieces");
    v("max_speed", prediction.max_speed, Range::positive(1e3),
      "of an estimated track, m/s per axis: bounds α's growth; a track's top speed beyond its pieces");
    v("sigma_acceleration", tracker.acceleration.sigma, Range::positive(1e3),
      "√ of the spectral density of acceleration per axis, m/s^1.5. 2 is right for the paper's trefoils, 0.5 for "
      "SANDO's, 0.3 for walking people. With `acceleration_time_s` > 0: the standard deviation of acceleration, m/s²; "
      "SANDO's 0.35, the paper's 4 … 5");
    v("acceleration_time_s", tracker.acceleration.time_s, Range{0.0, 1e3},
      "how long accelerations last, s (Singer's τ); 0: white, constant velocity. SANDO's trefoils 1.5, the paper's "
      "0.5");
    v("confirm_hits", tracker.confirm_hits, Range{1, 32}, "a track is published after so many detections …");
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
