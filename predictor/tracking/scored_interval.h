// The interval of one stored prediction, and its scores. Step 7 of docs/prediction.md.
#pragma once

#include <array>
#include <cstddef>

#include "core/world/track.h"
#include "core/world/track_class.h"
#include "predictor/tracking/calibration.h"

namespace tern {

/// The scores of one prediction.
struct ScoredPrediction {
  TrackClass of;
  std::size_t bands = 0;    ///< number of bands, from the first, that were evaluated to their end
  PerBand<float> scores{};  ///< the largest covering_margin() of each band
};

/// The interval of one prediction at each level of confidence, with the margins of the time when it was made. Errors
/// are added in order of time ahead.
class ScoredInterval {
 public:
  ScoredInterval() = default;
  ScoredInterval(TrackClass of, const Calibration& calibration);

  /// Adds the error at one of kEvaluatedAhead.
  /// @param error  per axis, absolute, m
  /// @param score  the least margin that covers the error. If two tracks exchanged detections (exchange.h) it may be
  ///   less, since a box of the other track covers as well
  void add(const Vec3& error, const Vec3& deviation, double score, double ahead_s);
  /// Ends a band: its score goes to the calibration.
  void end_band(std::size_t band, Calibration& calibration);
  [[nodiscard]] const ScoredPrediction& scored() const { return scored_; }

 private:
  ScoredPrediction scored_;
  PerLevel margins_{};
  SceneSpeed scene_speed_ = SceneSpeed::Any;                 // of the prior in use
  std::array<Vec3, kConfidenceLevels.size()> half_width_{};  // running maximum over time
  std::array<bool, kConfidenceLevels.size()> missed_{};
  double score_ = -kModelSigmas;  // the largest of the current band
};

}  // namespace tern
