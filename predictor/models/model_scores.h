// Which motion model predicts best, by horizon: scores of what was predicted against what came.
#pragma once

#include <array>
#include <cstddef>

#include "predictor/models/model_bank.h"

namespace tern {

/// Predictions are scored so far ahead, s: what the planner needs, not the next detection, which sways with a walker's
/// head and would choose a smooth model for people.
inline constexpr std::array<double, 4> kScoredAhead{0.25, 0.5, 1.0, 2.0};
inline constexpr std::size_t kScoredHorizons = kScoredAhead.size();
/// A track's predictions are scored once in so many seconds.
inline constexpr double kScorePeriod = 0.25;
/// Forgetting per score: of all tracks of a kind, and of one track.
inline constexpr double kPoolForgetting = 0.98;
inline constexpr double kOwnForgetting = 0.9;
/// No model falls behind the best one by more, so that it can come back (the floor that M. Herbster's and M. K.
/// Warmuth's fixed share keeps, "Tracking the best expert", 1998).
inline constexpr double kFarthestBehind = 8.0;
/// What weighs less is not used.
inline constexpr double kLeastWeight = 0.02;

/// log density of Student's t (ν = 4) with scale² `variance`, up to a constant: one surprise does not decide alone.
double predictive_score(double error, double variance);

/// Sums of scores by horizon and model. Scores of overlapping spans are not independent: one over h counts
/// kScorePeriod/h.
class ModelScores {
 public:
  void add(std::size_t horizon, const PerModel<double>& scores, double forgetting);
  [[nodiscard]] const PerModel<double>& at(std::size_t horizon) const { return sums_[horizon]; }
  PerModel<double>& at(std::size_t horizon) { return sums_[horizon]; }

 private:
  std::array<PerModel<double>, kScoredHorizons> sums_{};
};

using HorizonWeights = std::array<PerModel<double>, kScoredHorizons>;

/// Softmax of the sums of both, without what weighs less than kLeastWeight.
HorizonWeights model_weights(const ModelScores& pool, const ModelScores& own);

/// Linear in log time between the scored horizons, that of the nearest one outside. Sums to 1.
PerModel<double> weights_at(const HorizonWeights& weights, double ahead_s);

/// What the bank says of some time ahead: mean and deviation of the mixture, per axis of W.
struct Mixed {
  Vec3 centre = Vec3::Zero();     ///< m
  Vec3 velocity = Vec3::Zero();   ///< m/s
  Vec3 deviation = Vec3::Zero();  ///< of the centre, m
};
Mixed mixed(const BankFilter& bank, const BankLook& ahead, const PerModel<double>& weights);

}  // namespace tern
