#include "predictor/models/model_scores.h"

#include <algorithm>
#include <cmath>

namespace tern {
namespace {

constexpr double kDegreesOfFreedom = 4.0;

// Over the first `count` candidates.
PerCandidate<double> softmax(const PerCandidate<double>& a, const PerCandidate<double>& b, std::size_t count) {
  PerCandidate<double> sum{};
  for (std::size_t j = 0; j < count; ++j) sum[j] = a[j] + b[j];
  const auto end = sum.begin() + static_cast<std::ptrdiff_t>(count);
  const double best = *std::max_element(sum.begin(), end);
  double all = 0.0;
  std::for_each(sum.begin(), end, [&](double& s) { all += s = std::exp(s - best); });
  double kept = 0.0;
  for (double& s : sum) kept += s = s / all < kMinWeight ? 0.0 : s;
  for (double& s : sum) s /= kept;
  return sum;
}

}  // namespace

double predictive_score(double error, double variance) {
  return -0.5 * (kDegreesOfFreedom + 1.0) * std::log1p(error * error / (kDegreesOfFreedom * variance)) -
         0.5 * std::log(variance);
}

ModelScores::ModelScores(double initial_learnt_score) {
  for (Sums& sums : sums_) sums.learnt.fill(initial_learnt_score);
}

void ModelScores::add(std::size_t horizon, const PerCandidate<double>& scores, std::optional<std::size_t> group,
                      double forgetting) {
  Sums& sums = sums_[horizon];
  const auto added = [&](double sum, double score) {
    return forgetting * sum + score_weight(kScoredAhead[horizon]) * score;
  };
  for (std::size_t j = 0; j < kModels; ++j) sums.bank[j] = added(sums.bank[j], scores[j]);
  const double best = *std::max_element(sums.bank.begin(), sums.bank.end());
  for (double& sum : sums.bank) sum = std::max(sum - best, -kMaxScoreGap);
  if (!group) return;
  // The learnt model may be far ahead of the bank, whose models keep their differences.
  double& learnt = sums.learnt[*group];
  learnt = std::clamp(added(learnt, scores[kLearnt]) - best, -kMaxScoreGap, kMaxScoreGap);
}

PerCandidate<double> ModelScores::at(std::size_t horizon, std::optional<std::size_t> group) const {
  PerCandidate<double> all;
  std::copy(sums_[horizon].bank.begin(), sums_[horizon].bank.end(), all.begin());
  all[kLearnt] = group ? sums_[horizon].learnt[*group] : 0.0;
  return all;
}

HorizonWeights model_weights(const ModelScores& pool, const ModelScores& own, std::optional<std::size_t> group,
                             double learnt_horizon_s) {
  HorizonWeights weights;
  weights.learnt_horizon_s = learnt_horizon_s;
  for (std::size_t h = 0; h < kScoredHorizons; ++h) {
    const PerCandidate<double> pool_scores = pool.at(h, group), own_scores = own.at(h, group);
    weights.without_learnt[h] = softmax(pool_scores, own_scores, kModels);
    if (kScoredAhead[h] <= learnt_horizon_s) {
      weights.with_learnt[h] = softmax(pool_scores, own_scores, kModels + 1);
    } else {
      weights.with_learnt[h] = h == 0 ? weights.without_learnt[h] : weights.with_learnt[h - 1];
    }
  }
  return weights;
}

PerCandidate<double> weights_at(const HorizonWeights& weights, double ahead_s) {
  std::size_t h = 0;
  while (h + 2 < kScoredHorizons && ahead_s > kScoredAhead[h + 1]) ++h;
  const double u = std::clamp(std::log2(ahead_s / kScoredAhead[h]), 0.0, 1.0);  // each is twice the one before
  double faded = 1.0;
  if (weights.learnt_horizon_s > 0.0)
    faded = std::clamp((ahead_s / weights.learnt_horizon_s - 1.0) / (kLearntFade - 1.0), 0.0, 1.0);
  const auto between = [&](const HorizonWeights::Scored& of, std::size_t j) {
    return (1.0 - u) * of[h][j] + u * of[h + 1][j];
  };
  PerCandidate<double> sum;
  for (std::size_t j = 0; j < sum.size(); ++j) {
    sum[j] = faded >= 1.0
                 ? between(weights.without_learnt, j)
                 : (1.0 - faded) * between(weights.with_learnt, j) + faded * between(weights.without_learnt, j);
  }
  return sum;
}

MixturePrediction mixture_prediction(const BankFilter& bank, const BankOutputRows& ahead,
                                     const FilterPrediction& learnt, const PerCandidate<double>& weights) {
  MixturePrediction sum;
  PerCandidate<FilterPrediction> predicted;
  for (std::size_t j = 0; j < predicted.size(); ++j) {
    if (weights[j] <= 0.0) continue;
    predicted[j] = j == kLearnt ? learnt : bank.of(j).at(ahead[j]);
    sum.centre += weights[j] * predicted[j].position;
    sum.velocity += weights[j] * predicted[j].velocity;
  }
  Vec3 variance = Vec3::Zero();
  for (std::size_t j = 0; j < predicted.size(); ++j) {
    if (weights[j] <= 0.0) continue;
    variance += weights[j] * (predicted[j].variance + (predicted[j].position - sum.centre).cwiseAbs2());
  }
  sum.deviation = variance.cwiseSqrt();
  return sum;
}

}  // namespace tern
