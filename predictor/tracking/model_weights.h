// Weighs the motion models by the scores of stored predictions. Steps 5 and 6 of docs/prediction.md.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "core/base/time.h"
#include "core/world/track_class.h"
#include "predictor/models/model_scores.h"
#include "predictor/tracking/detected_track.h"
#include "predictor/tracking/smoothed_position.h"

namespace tern {

/// The scores of one track.
struct TrackScores {
  ModelScores scores;
  double recent_speed = 0.0;  ///< m/s, decays

  /// Takes a detection. @param gap_s  since the one before, s; 0 for the first
  void add_speed(const DetectedTrack& track, UTime at, double gap_s);
};

/// The predictions of all models for one track, at each of kScoredAhead.
struct ModelPredictions {
  struct Prediction {
    Vec3 centre, variance;  ///< W, m; m²
  };
  std::array<PerCandidate<Prediction>, kScoredHorizons> at;
  std::size_t pool = 0;              ///< ModelWeights::pool_of() then
  std::optional<std::size_t> group;  ///< of the learnt model
  double learnt_horizon_s = 0.0;     ///< the learnt model took part up to here; 0: not at all
};

/// The scores of all models, by pool of tracks. Slow and fast tracks that are no longer young have a pool each. Young
/// tracks have the pool of all tracks, because their speed is unknown.
class ModelWeights {
 public:
  ModelWeights();

  /// Returns the weights of the models for a track of a pool.
  /// @param learnt_horizon_s  0 without a group
  [[nodiscard]] HorizonWeights of(std::size_t pool, const TrackScores& own, std::optional<std::size_t> group,
                                  double learnt_horizon_s) const;
  /// Adds the scores of all models at one of kScoredAhead to the track, its pool, and the pool of all tracks.
  void add(const ModelPredictions& predicted, std::size_t horizon, const Measurement& truth, TrackScores& own);

  [[nodiscard]] static std::size_t pool_of(const DetectedTrack& track, UTime at, const TrackScores& own);

 private:
  std::array<ModelScores, 3> pools_;
};

/// Returns the class of a track: its age, and the kind of models with the most weight 1 s ahead.
TrackClass track_class(const DetectedTrack& track, UTime at, const HorizonWeights& weights);

}  // namespace tern
