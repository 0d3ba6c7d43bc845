#include "predictor/tracking/calibration_prior.h"

#include <algorithm>

#include "predictor/tracking/calibration.h"

namespace tern {
namespace {

struct Row {
  std::array<double, kConfidenceLevels.size()> levels;
  std::array<double, kPriorProbabilities.size()> quantiles;
};
// Made by `tern-calibrate --made-up 100 --prior FILE`, from made-up movers alone.
constexpr std::array<Row, kSceneSpeeds * kClasses * kBands> kTable{{
#include "predictor/tracking/calibration_prior.inc"
}};

const Row& row(SceneSpeed scene_speed, std::size_t k, std::size_t band) {
  return kTable[(static_cast<std::size_t>(scene_speed) * kClasses + k) * kBands + band];
}

}  // namespace

double prior_share_above(SceneSpeed scene_speed, std::size_t k, std::size_t band, double q) {
  const auto& quantiles = row(scene_speed, k, band).quantiles;
  const auto next = std::upper_bound(quantiles.begin(), quantiles.end(), q);
  if (next == quantiles.begin()) return 1.0;
  if (next == quantiles.end()) return 0.0;
  const auto above = static_cast<std::size_t>(next - quantiles.begin());
  const double u = (q - quantiles[above - 1]) / (quantiles[above] - quantiles[above - 1]);
  return 1.0 - (1.0 - u) * kPriorProbabilities[above - 1] - u * kPriorProbabilities[above];
}

double prior_level(SceneSpeed scene_speed, std::size_t k, std::size_t band, std::size_t level) {
  return row(scene_speed, k, band).levels[level];
}

}  // namespace tern
