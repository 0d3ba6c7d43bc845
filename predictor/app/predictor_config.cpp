#include "predictor/app/predictor_config.h"

#include <string>

#include "core/wire/message_limits.h"

namespace tern {

PredictorConfig read_predictor_config(ConfigSection section) {
  PredictorConfig config;
  section.read(config);
  const TrackerConfig& tracker = config.tracker;
  if (tracker.confirm_hits > tracker.confirm_window) {
    throw section.error("confirm_hits", std::to_string(tracker.confirm_hits) + " is more than confirm_window, " +
                                            std::to_string(tracker.confirm_window));
  }
  const std::size_t pieces = piece_ends(tracker.prediction).size() - 1;
  if (pieces > static_cast<std::size_t>(kMaxPiecesPerBatch)) {
    throw section.error("piece_s", std::to_string(pieces) + " pieces up to horizon_s are more than a message holds, " +
                                       std::to_string(kMaxPiecesPerBatch) + ": set longer pieces, or piece_growth");
  }
  return config;
}

}  // namespace tern
