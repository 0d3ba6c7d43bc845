// Scores of the motion models by horizon, the weights that follow, and the mixture that they make.
// Equations: docs/prediction.md, steps 5 and 6.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "core/world/track_class.h"
#include "predictor/models/learnt_model.h"
#include "predictor/models/model_bank.h"

namespace tern {

/// The times ahead at which models are scored, s: those that the planner needs. The likelihood of the next detection is
/// no measure of that. It would favour models that follow a walker's swaying head, and are poor a second ahead.
/// They are all of kCoverageHorizons but the last, which is too far ahead for models to differ in kind.
inline constexpr std::size_t kScoredHorizons = kHorizons - 1;
inline constexpr std::array<double, kScoredHorizons> kScoredAhead = [] {
  std::array<double, kScoredHorizons> ahead{};
  for (std::size_t h = 0; h < kScoredHorizons; ++h) ahead[h] = kCoverageHorizons[h];
  return ahead;
}();
/// The time between two scored predictions of a track, s.
inline constexpr double kScorePeriod = 0.25;
/// Returns the weight of a score over the span `ahead_s`, (0, 1]. Overlapping spans have correlated scores: one score
/// counts as kScorePeriod/ahead_s independent ones.
constexpr double score_weight(double ahead_s) { return ahead_s > kScorePeriod ? kScorePeriod / ahead_s : 1.0; }
/// Factor on the sum of scores at each new one: for the tracks of a pool, and for one track.
inline constexpr double kPoolForgetting = 0.98;
inline constexpr double kOwnForgetting = 0.9;
/// Every model's sum stays within this of the sum of the bank's best model, so every model can recover. It is the floor
/// that fixed share keeps (M. Herbster, M. K. Warmuth, "Tracking the best expert", 1998). The learnt model is also at
/// most this much ahead.
inline constexpr double kMaxScoreGap = 8.0;
/// Smaller weights are set to 0.
inline constexpr double kMinWeight = 0.02;

/// Index of the learnt model (learnt_model.h). It follows the models of the bank.
inline constexpr std::size_t kLearnt = kModels;
template <typename T>
using PerCandidate = std::array<T, kModels + 1>;

/// Returns the log density of Student's t (ν = 4) with scale² `variance`, up to a constant. Its heavy tails keep one
/// outlier from deciding alone.
double predictive_score(double error, double variance);

/// Discounted, weighted sums of scores per horizon and model, relative to the best model of the bank. The learnt model
/// has a sum per group of ages, because its record on old tracks does not apply to new ones.
class ModelScores {
 public:
  ModelScores() = default;
  /// @param initial_learnt_score  first value of the learnt model's sums
  explicit ModelScores(double initial_learnt_score);
  /// @param group  the group of the learnt model's score; without a group, that score is ignored
  void add(std::size_t horizon, const PerCandidate<double>& scores, std::optional<std::size_t> group,
           double forgetting);
  /// Returns the sums of all models. Without a group, that of the learnt model is 0.
  [[nodiscard]] PerCandidate<double> at(std::size_t horizon, std::optional<std::size_t> group) const;

 private:
  struct Sums {
    std::array<double, kModels> bank{};
    std::array<double, kLearntGroups> learnt{};
  };
  std::array<Sums, kScoredHorizons> sums_{};
};

/// The weights of the models at the scored horizons.
struct HorizonWeights {
  using Scored = std::array<PerCandidate<double>, kScoredHorizons>;
  Scored with_learnt, without_learnt;
  double learnt_horizon_s = 0.0;  ///< the learnt model takes part up to here; 0: not at all
};

/// Returns the softmax of the sums of `pool` and `own` together, without weights below kMinWeight.
/// @param group  of the learnt model; @param learnt_horizon_s  0 without a group
HorizonWeights model_weights(const ModelScores& pool, const ModelScores& own, std::optional<std::size_t> group,
                             double learnt_horizon_s);

/// Returns the weights at a time ahead; they sum to 1. They are linear in log time between the scored horizons and
/// constant outside them. From learnt_horizon_s to kLearntFade times that, the learnt model's weight fades to 0.
PerCandidate<double> weights_at(const HorizonWeights& weights, double ahead_s);
inline constexpr double kLearntFade = 1.2;

/// Mean and standard deviation of the mixture at a time ahead, per axis of W.
struct MixturePrediction {
  Vec3 centre = Vec3::Zero();     ///< m
  Vec3 velocity = Vec3::Zero();   ///< m/s
  Vec3 deviation = Vec3::Zero();  ///< of the centre, m
};
/// @param learnt  the learnt model's prediction; ignored if its weight is 0
MixturePrediction mixture_prediction(const BankFilter& bank, const BankOutputRows& ahead,
                                     const FilterPrediction& learnt, const PerCandidate<double>& weights);

}  // namespace tern
