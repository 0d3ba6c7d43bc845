// Which motion model predicts best, by horizon: scores of what was predicted against what came.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "predictor/models/learnt_model.h"
#include "predictor/models/model_bank.h"

namespace tern {

/// Predictions are scored so far ahead, s: what the planner needs, not the next detection, which sways with a walker's
/// head and would choose a smooth model for people.
inline constexpr std::array<double, 4> kScoredAhead{0.25, 0.5, 1.0, 2.0};
inline constexpr std::size_t kScoredHorizons = kScoredAhead.size();
/// A track's predictions are scored once in so many seconds.
inline constexpr double kScorePeriod = 0.25;
/// Scores of spans that overlap are alike: for how many independent ones one over `ahead_s` counts, (0, 1].
constexpr double score_weight(double ahead_s) { return ahead_s > kScorePeriod ? kScorePeriod / ahead_s : 1.0; }
/// Forgetting per score: of all tracks of a kind, and of one track.
inline constexpr double kPoolForgetting = 0.98;
inline constexpr double kOwnForgetting = 0.9;
/// No model falls behind the best given one by more, so that it can come back (the floor that M. Herbster's and M. K.
/// Warmuth's fixed share keeps, "Tracking the best expert", 1998), nor is the learnt one ahead of it by more.
inline constexpr double kMaxScoreGap = 8.0;
/// What weighs less is not used.
inline constexpr double kMinWeight = 0.02;

/// The bank's models and, last, the one that is learnt (learnt_model.h).
inline constexpr std::size_t kLearnt = kModels;
template <typename T>
using PerCandidate = std::array<T, kModels + 1>;

/// log density of Student's t (ν = 4) with scale² `variance`, up to a constant: one surprise does not decide alone.
double predictive_score(double error, double variance);

/// Sums of scores by horizon and model, each as it is worth, against the best given model's. The learnt one has a sum
/// for each of its groups: how well it foretells tracks that it has watched for long says nothing of those that just
/// came.
class ModelScores {
 public:
  ModelScores() = default;
  /// @param initial_learnt_score  what the learnt model's sums begin with
  explicit ModelScores(double initial_learnt_score);
  /// @param group  the learnt model's, to which its score belongs; without one that is not looked at
  void add(std::size_t horizon, const PerCandidate<double>& scores, std::optional<std::size_t> group,
           double forgetting);
  /// @param group  without one the learnt model's is that of none, 0
  [[nodiscard]] PerCandidate<double> at(std::size_t horizon, std::optional<std::size_t> group) const;

 private:
  struct Sums {
    std::array<double, kModels> bank{};
    std::array<double, kLearntGroups> learnt{};
  };
  std::array<Sums, kScoredHorizons> sums_{};
};

/// How much each candidate counts, at the scored horizons.
struct HorizonWeights {
  using Scored = std::array<PerCandidate<double>, kScoredHorizons>;
  Scored with_learnt, without_learnt;  ///< with the learnt model, and without
  double learnt_horizon_s = 0.0;       ///< s ahead, the learnt model says something; 0: nothing
};

/// Softmax of the sums of both, without what weighs less than kLeastWeight.
/// @param group  of the learnt model  @param learnt_to  HorizonWeights::learnt_to; 0 where there is no group
HorizonWeights model_weights(const ModelScores& pool, const ModelScores& own, std::optional<std::size_t> group,
                             double learnt_horizon_s);

/// Linear in log time between the horizons, that of the nearest one outside. From learnt_to to kUnlearnt times that the
/// learnt model's weight fades. Sums to 1.
PerCandidate<double> weights_at(const HorizonWeights& weights, double ahead_s);
inline constexpr double kLearntFade = 1.2;

/// What the bank says of some time ahead: mean and deviation of the mixture, per axis of W.
struct MixturePrediction {
  Vec3 centre = Vec3::Zero();     ///< m
  Vec3 velocity = Vec3::Zero();   ///< m/s
  Vec3 deviation = Vec3::Zero();  ///< of the centre, m
};
/// @param learnt  what the learnt model says; not looked at if its weight is 0
MixturePrediction mixture_prediction(const BankFilter& bank, const BankOutputRows& ahead,
                                     const FilterPrediction& learnt, const PerCandidate<double>& weights);

}  // namespace tern
