// The section `predictor:` of a scenario file.
#pragma once

#include "predictor/tracking/tracker.h"
#include "runtime/config.h"

namespace tern {

enum class PredictorModel { Declared, ConstantVelocity, Both };

struct PredictorConfig {
  PredictorModel model = PredictorModel::Both;
  Duration period{50'000};  ///< between published sets, > 0
  TrackerConfig tracker;    ///< its prediction.horizon serves the declared model too
};

/// Reads and finishes the section; README.md is the table of keys. @throws ConfigError.
PredictorConfig read_predictor_config(ConfigSection section);

}  // namespace tern
