#include "predictor/models/model_scores.h"

#include <algorithm>
#include <cmath>

namespace tern {
namespace {

constexpr double kDegrees = 4.0;

PerModel<double> softmax(const PerModel<double>& a, const PerModel<double>& b) {
  PerModel<double> sum;
  for (std::size_t j = 0; j < kModels; ++j) sum[j] = a[j] + b[j];
  const double best = *std::max_element(sum.begin(), sum.end());
  double all = 0.0;
  for (double& s : sum) all += s = std::exp(s - best);
  double kept = 0.0;
  for (double& s : sum) kept += s = s / all < kLeastWeight ? 0.0 : s;
  for (double& s : sum) s /= kept;
  return sum;
}

}  // namespace

double predictive_score(double error, double variance) {
  return -0.5 * (kDegrees + 1.0) * std::log1p(error * error / (kDegrees * variance)) - 0.5 * std::log(variance);
}

void ModelScores::add(std::size_t horizon, const PerModel<double>& scores, double forgetting) {
  PerModel<double>& sums = sums_[horizon];
  const double weight = std::min(1.0, kScorePeriod / kScoredAhead[horizon]);
  for (std::size_t j = 0; j < kModels; ++j) sums[j] = forgetting * sums[j] + weight * scores[j];
  const double best = *std::max_element(sums.begin(), sums.end());
  for (double& sum : sums) sum = std::max(sum - best, -kFarthestBehind);
}

HorizonWeights model_weights(const ModelScores& pool, const ModelScores& own) {
  HorizonWeights weights;
  for (std::size_t h = 0; h < kScoredHorizons; ++h) weights[h] = softmax(pool.at(h), own.at(h));
  return weights;
}

PerModel<double> weights_at(const HorizonWeights& weights, double ahead_s) {
  if (ahead_s <= kScoredAhead.front()) return weights.front();
  if (ahead_s >= kScoredAhead.back()) return weights.back();
  std::size_t h = 0;
  while (ahead_s > kScoredAhead[h + 1]) ++h;
  const double u = std::log2(ahead_s / kScoredAhead[h]);  // each is twice the one before
  PerModel<double> between;
  for (std::size_t j = 0; j < kModels; ++j) between[j] = (1.0 - u) * weights[h][j] + u * weights[h + 1][j];
  return between;
}

Mixed mixed(const BankFilter& bank, const BankLook& ahead, const PerModel<double>& weights) {
  Mixed sum;
  std::array<FilterLook, kModels> said;
  for (std::size_t j = 0; j < kModels; ++j) {
    if (weights[j] <= 0.0) continue;
    said[j] = bank.of(j).at(ahead[j]);
    sum.centre += weights[j] * said[j].position;
    sum.velocity += weights[j] * said[j].velocity;
  }
  Vec3 variance = Vec3::Zero();
  for (std::size_t j = 0; j < kModels; ++j) {
    if (weights[j] <= 0.0) continue;
    variance += weights[j] * (said[j].variance + (said[j].position - sum.centre).cwiseAbs2());
  }
  sum.deviation = variance.cwiseSqrt();
  return sum;
}

}  // namespace tern
