#include "predictor/models/model_scores.h"

#include <algorithm>
#include <cmath>

namespace tern {
namespace {

constexpr double kDegrees = 4.0;

// Over the first `count` candidates.
PerCandidate<double> softmax(const PerCandidate<double>& a, const PerCandidate<double>& b, std::size_t count) {
  PerCandidate<double> sum{};
  for (std::size_t j = 0; j < count; ++j) sum[j] = a[j] + b[j];
  const auto end = sum.begin() + static_cast<std::ptrdiff_t>(count);
  const double best = *std::max_element(sum.begin(), end);
  double all = 0.0;
  std::for_each(sum.begin(), end, [&](double& s) { all += s = std::exp(s - best); });
  double kept = 0.0;
  for (double& s : sum) kept += s = s / all < kLeastWeight ? 0.0 : s;
  for (double& s : sum) s /= kept;
  return sum;
}

}  // namespace

double predictive_score(double error, double variance) {
  return -0.5 * (kDegrees + 1.0) * std::log1p(error * error / (kDegrees * variance)) - 0.5 * std::log(variance);
}

ModelScores::ModelScores(double learnt_lead) {
  for (Sums& sums : sums_) sums.learnt.fill(learnt_lead);
}

void ModelScores::add(std::size_t horizon, const PerCandidate<double>& scores, std::optional<std::size_t> group,
                      double forgetting) {
  Sums& sums = sums_[horizon];
  const auto added = [&](double sum, double score) { return forgetting * sum + worth(kScoredAhead[horizon]) * score; };
  for (std::size_t j = 0; j < kModels; ++j) sums.given[j] = added(sums.given[j], scores[j]);
  const double best = *std::max_element(sums.given.begin(), sums.given.end());
  for (double& sum : sums.given) sum = std::max(sum - best, -kFarthestBehind);
  if (!group) return;
  // What is learnt may be far ahead of all given models: what these are to each other stays.
  double& learnt = sums.learnt[*group];
  learnt = std::clamp(added(learnt, scores[kLearnt]) - best, -kFarthestBehind, kFarthestBehind);
}

PerCandidate<double> ModelScores::at(std::size_t horizon, std::optional<std::size_t> group) const {
  PerCandidate<double> all;
  std::copy(sums_[horizon].given.begin(), sums_[horizon].given.end(), all.begin());
  all[kLearnt] = group ? sums_[horizon].learnt[*group] : 0.0;
  return all;
}

HorizonWeights model_weights(const ModelScores& pool, const ModelScores& own, std::optional<std::size_t> group,
                             double learnt_to) {
  HorizonWeights weights;
  weights.learnt_to = learnt_to;
  for (std::size_t h = 0; h < kScoredHorizons; ++h) {
    const PerCandidate<double> of_pool = pool.at(h, group), of_own = own.at(h, group);
    weights.given[h] = softmax(of_pool, of_own, kModels);
    if (kScoredAhead[h] <= learnt_to) {
      weights.all[h] = softmax(of_pool, of_own, kModels + 1);
    } else {
      weights.all[h] = h == 0 ? weights.given[h] : weights.all[h - 1];
    }
  }
  return weights;
}

PerCandidate<double> weights_at(const HorizonWeights& weights, double ahead_s) {
  std::size_t h = 0;
  while (h + 2 < kScoredHorizons && ahead_s > kScoredAhead[h + 1]) ++h;
  const double u = std::clamp(std::log2(ahead_s / kScoredAhead[h]), 0.0, 1.0);  // each is twice the one before
  double faded = 1.0;
  if (weights.learnt_to > 0.0) faded = std::clamp((ahead_s / weights.learnt_to - 1.0) / (kUnlearnt - 1.0), 0.0, 1.0);
  const auto between = [&](const HorizonWeights::Scored& of, std::size_t j) {
    return (1.0 - u) * of[h][j] + u * of[h + 1][j];
  };
  PerCandidate<double> sum;
  for (std::size_t j = 0; j < sum.size(); ++j) {
    sum[j] = faded >= 1.0 ? between(weights.given, j)
                          : (1.0 - faded) * between(weights.all, j) + faded * between(weights.given, j);
  }
  return sum;
}

Mixed mixed(const BankFilter& bank, const BankLook& ahead, const FilterLook& learnt,
            const PerCandidate<double>& weights) {
  Mixed sum;
  PerCandidate<FilterLook> said;
  for (std::size_t j = 0; j < said.size(); ++j) {
    if (weights[j] <= 0.0) continue;
    said[j] = j == kLearnt ? learnt : bank.of(j).at(ahead[j]);
    sum.centre += weights[j] * said[j].position;
    sum.velocity += weights[j] * said[j].velocity;
  }
  Vec3 variance = Vec3::Zero();
  for (std::size_t j = 0; j < said.size(); ++j) {
    if (weights[j] <= 0.0) continue;
    variance += weights[j] * (said[j].variance + (said[j].position - sum.centre).cwiseAbs2());
  }
  sum.deviation = variance.cwiseSqrt();
  return sum;
}

}  // namespace tern
