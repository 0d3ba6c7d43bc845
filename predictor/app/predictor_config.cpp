#include "predictor/app/predictor_config.h"

#include <string>

#include "core/world/message_limits.h"

namespace tern {

PredictorConfig read_predictor_config(ConfigSection section) {
  PredictorConfig config;
  TrackerConfig& tracker = config.tracker;
  PredictionSpec& prediction = tracker.prediction;

  const std::string model = section.choice("model", "both", {"declared", "constant_velocity", "both"});
  config.model = model == "declared" ? PredictorModel::Declared
                 : model == "both"   ? PredictorModel::Both
                                     : PredictorModel::ConstantVelocity;
  config.period = Duration::from_seconds(1.0 / section.number("rate_hz", 20.0, Range::at_least(1.0, 100.0)));
  prediction.horizon =
      Duration::from_seconds(section.number("horizon_s", prediction.horizon.seconds(), Range::at_least(0.1, 30.0)));
  prediction.piece =
      Duration::from_seconds(section.number("piece_s", prediction.piece.seconds(), Range::at_least(0.05, 5.0)));
  prediction.piece_growth = section.number("piece_growth", prediction.piece_growth, Range::at_least(0.0, 1.0));
  prediction.confidence = section.number("confidence", prediction.confidence, Range::at_least(0.5, 0.999999));
  prediction.max_speed = section.number("max_speed", prediction.max_speed, Range::positive(1e3));
  AccelerationModel& acceleration = tracker.acceleration;
  acceleration.sigma = section.number("sigma_acceleration", acceleration.sigma, Range::positive(1e3));
  acceleration.time_s = section.number("acceleration_time_s", acceleration.time_s, Range::at_least(0.0, 1e3));
  tracker.confirm_window = static_cast<int>(section.integer("confirm_window", tracker.confirm_window, 1, 32));
  tracker.confirm_hits = static_cast<int>(section.integer("confirm_hits", tracker.confirm_hits, 1, 32));
  tracker.coast =
      Duration::from_seconds(section.number("coast_s", tracker.coast.seconds(), Range::at_least(0.0, 60.0)));
  tracker.resting_after = Duration::from_seconds(
      section.number("resting_after_s", tracker.resting_after.seconds(), Range::at_least(0.1, 1e6)));
  tracker.remember_rest = Duration::from_seconds(
      section.number("remember_rest_s", tracker.remember_rest.seconds(), Range::at_least(0.0, 1e6)));
  section.finish();
  if (tracker.confirm_hits > tracker.confirm_window) {
    throw section.error("confirm_hits", std::to_string(tracker.confirm_hits) + " is more than confirm_window, " +
                                            std::to_string(tracker.confirm_window));
  }
  const std::size_t pieces = piece_ends(prediction).size() - 1;
  if (pieces > static_cast<std::size_t>(kMaxPiecesPerBatch)) {
    throw section.error("piece_s", std::to_string(pieces) + " pieces up to horizon_s are more than a message takes, " +
                                       std::to_string(kMaxPiecesPerBatch) + ": longer pieces, or piece_growth");
  }
  return config;
}

}  // namespace tern
