#include "predictor/tracking/calibration_prior.h"

#include <array>

#include "predictor/tracking/calibration.h"

namespace tern {
namespace {

struct Row {
  double level;
  std::array<double, kPriorProbabilities.size()> quantiles;
};
constexpr std::array<Row, kTrackClasses * kBands> kTable{{
#include "predictor/tracking/calibration_prior.inc"
}};

constexpr std::size_t kCount = 199;   // prime
constexpr std::size_t kStride = 123;  // near kCount over the golden ratio: neighbours in age are not alike

double quantile(const Row& row, double p) {
  std::size_t k = 1;
  while (p > kPriorProbabilities[k]) ++k;
  const double u = (p - kPriorProbabilities[k - 1]) / (kPriorProbabilities[k] - kPriorProbabilities[k - 1]);
  return (1.0 - u) * row.quantiles[k - 1] + u * row.quantiles[k];
}

}  // namespace

std::vector<float> prior_scores(std::size_t kind, std::size_t band) {
  const Row& row = kTable[kind * kBands + band];
  std::vector<float> scores(kCount);
  for (std::size_t i = 0; i < kCount; ++i) {
    const std::size_t rank = (i * kStride) % kCount;
    scores[i] = static_cast<float>(quantile(row, (static_cast<double>(rank) + 0.5) / kCount));
  }
  return scores;
}

double prior_level(std::size_t kind, std::size_t band) { return kTable[kind * kBands + band].level; }

}  // namespace tern
