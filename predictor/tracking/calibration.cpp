#include "predictor/tracking/calibration.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "predictor/tracking/calibration_prior.h"

namespace tern {
namespace {

// Of 1 − confidence, what may be broken by the end of each band: errors of the later bands come on top.
constexpr PerBand<double> kAllowedShare{0.5, 0.65, 0.8, 1.0, 1.3};

}  // namespace

std::size_t band_of(double ahead_s) {
  std::size_t band = 0;
  while (band + 1 < kBands && ahead_s > kBandEnds[band]) ++band;
  return band;
}

double margin_growth(std::size_t band, double ahead_s) {
  return (ahead_s + kMarginStart) / (kBandEnds[band] + kMarginStart);
}

BandScores::BandScores(std::vector<float> scores, double level)
    : newest_(std::move(scores)), sorted_(newest_), level_(level) {
  std::sort(sorted_.begin(), sorted_.end());
}

void BandScores::add(float score, bool missed, double epsilon) {
  level_ = std::min(kLargestLevel, std::max(kLeastLevel, level_ + kAdaption * (epsilon - (missed ? 1.0 : 0.0))));
  if (newest_.size() < kWindow) {
    newest_.push_back(score);
  } else {
    sorted_.erase(std::lower_bound(sorted_.begin(), sorted_.end(), newest_[oldest_]));
    newest_[oldest_] = score;
    oldest_ = (oldest_ + 1) % kWindow;
  }
  sorted_.insert(std::upper_bound(sorted_.begin(), sorted_.end(), score), score);
}

double BandScores::margin(double ratio) const {
  const auto n = static_cast<double>(sorted_.size());
  const double rank = std::ceil((n + 1.0) * (1.0 - level_ * ratio));
  return sorted_[static_cast<std::size_t>(std::min(std::max(rank, 1.0), n)) - 1];
}

Calibration::Calibration(double confidence) {
  for (std::size_t band = 0; band < kBands; ++band) allowed_[band] = kAllowedShare[band] * (1.0 - confidence);
  for (std::size_t kind = 0; kind < kTrackClasses; ++kind) {
    for (std::size_t band = 0; band < kBands; ++band) {
      scores_[kind].emplace_back(prior_scores(kind, band), prior_level(kind, band) * (1.0 - confidence) / kPriorMiss);
    }
  }
}

PerBand<double> Calibration::margins(TrackClass kind, double ratio) const {
  PerBand<double> all;
  for (std::size_t band = 0; band < kBands; ++band) {
    all[band] = scores_[static_cast<std::size_t>(kind)][band].margin(ratio);
  }
  return all;
}

void Calibration::add(TrackClass kind, std::size_t band, float score, bool missed) {
  scores_[static_cast<std::size_t>(kind)][band].add(score, missed, allowed_[band]);
}

}  // namespace tern
