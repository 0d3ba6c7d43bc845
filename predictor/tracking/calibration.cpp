#include "predictor/tracking/calibration.h"

#include <algorithm>
#include <cmath>

#include "predictor/models/model_scores.h"

namespace tern {
namespace {

// The allowed miss rate up to the end of each band, as a share of 1 − confidence. Later bands add their own misses.
constexpr PerBand<double> kAllowedShare{0.5, 0.6, 0.7, 0.85, 1.0};
// The largest margin, m; the reach set is smaller. The number of halvings gives 0.1 mm.
constexpr double kMaxMargin = 100.0;
constexpr int kHalvings = 20;

}  // namespace

std::size_t band_of(double ahead_s) {
  std::size_t band = 0;
  while (band + 1 < kBands && ahead_s > kCoverageHorizons[band]) ++band;
  return band;
}

double margin_growth(std::size_t band, double ahead_s) {
  return (ahead_s + kMarginStart) / (kCoverageHorizons[band] + kMarginStart);
}

Vec3 interval_half_width(const Vec3& deviation, const PerBand<double>& margins, double ahead_s) {
  const std::size_t band = band_of(ahead_s);
  const double margin = margins[band] * margin_growth(band, ahead_s);
  if (margin > 0.0) return kModelSigmas * deviation + Vec3::Constant(margin);
  return std::max(0.0, kModelSigmas + margin) * deviation;
}

double covering_margin(const Vec3& error, const Vec3& deviation, std::size_t band, double ahead_s) {
  double margin = -kModelSigmas;
  for (int axis = 0; axis < 3; ++axis) {
    const double beyond = std::abs(error[axis]) - kModelSigmas * deviation[axis];
    margin = std::max(margin, beyond > 0.0 ? beyond : beyond / deviation[axis]);
  }
  return std::max(-kModelSigmas, margin / margin_growth(band, ahead_s));
}

void NewestScores::add(float score) {
  if (newest_.size() < capacity_) {
    newest_.push_back(score);
  } else {
    sorted_.erase(std::lower_bound(sorted_.begin(), sorted_.end(), newest_[oldest_]));
    newest_[oldest_] = score;
    oldest_ = (oldest_ + 1) % capacity_;
  }
  sorted_.insert(std::upper_bound(sorted_.begin(), sorted_.end(), score), score);
}

double NewestScores::count_above(double q) const {
  const auto beyond = std::upper_bound(sorted_.begin(), sorted_.end(), q,
                                       [](double value, float score) { return value < static_cast<double>(score); });
  return static_cast<double>(sorted_.end() - beyond);
}

Calibration::Calibration(double confidence) {
  for (std::size_t level = 0; level < confidence_.size(); ++level) {
    confidence_[level] = confidence_at(confidence, static_cast<int>(level));
  }
  for (auto& pool : pools_) pool.assign(kBands, NewestScores(kPoolScores));
  for (Class& of : classes_) of.scores.assign(kBands, NewestScores(kOwnScores));
  begin(SceneSpeed::Any);
  refresh();
}

void Calibration::begin(SceneSpeed scene_speed) {
  scene_speed_ = scene_speed;
  for (std::size_t k = 0; k < kClasses; ++k) {
    for (std::size_t level = 0; level < confidence_.size(); ++level) {
      const double scale =
          (level == 0 ? 1.0 : kInitialLevel) * (1.0 - confidence_[level]) / (1.0 - kConfidenceLevels[level]);
      for (std::size_t band = 0; band < kBands; ++band) {
        classes_[k].log_theta[level][band] = std::log(scale * prior_level(scene_speed, k, band, level));
      }
    }
  }
  is_stale_.fill(true);
}

double Calibration::allowed(std::size_t level, std::size_t band) const {
  return kAllowedShare[band] * (1.0 - confidence_[level]);
}

double Calibration::score_weight(std::size_t band) { return tern::score_weight(kCoverageHorizons[band]); }

double Calibration::margin(std::size_t k, std::size_t band, double theta) const {
  const NewestScores &own = classes_[k].scores[band], &pool = pools_[kCalibratedClasses[k].pool][band];
  const double each = score_weight(band);
  const double of_pool = kPoolWeight / (kPriorWeight + each * pool.size());
  const double allowed = theta * (kPoolWeight + each * own.size());
  double low = -kModelSigmas, high = kMaxMargin;
  for (int halving = 0; halving < kHalvings; ++halving) {
    const double q = 0.5 * (low + high);
    const double above =
        of_pool * (kPriorWeight * prior_share_above(scene_speed_, k, band, q) + each * pool.count_above(q)) +
        each * own.count_above(q);
    (above <= allowed ? high : low) = q;
  }
  return high;
}

PerLevel Calibration::margins(TrackClass of, double real_share) const { return margins(class_index(of), real_share); }

PerLevel Calibration::margins(std::size_t k, double real_share) const {
  PerLevel margins;
  for (std::size_t level = 0; level < margins.size(); ++level) {
    for (std::size_t band = 0; band < kBands; ++band) {
      margins[level][band] = margin(k, band, std::exp(classes_[k].log_theta[level][band]) / real_share);
    }
  }
  return margins;
}

void Calibration::set_scene_speed(SceneSpeed scene_speed) {
  if (scene_speed != scene_speed_) begin(scene_speed);
}

void Calibration::add(TrackClass track, std::size_t band, float score,
                      const std::array<bool, kConfidenceLevels.size()>& missed, SceneSpeed made_under) {
  const std::size_t k = class_index(track), pool = kCalibratedClasses[k].pool;
  Class& of = classes_[k];
  if (pool == kPoolOfOld) of.scores[band].add(score);
  pools_[pool][band].add(score);
  is_stale_[pool] = true;
  if (made_under != scene_speed_) return;
  for (std::size_t level = 0; level < missed.size(); ++level) {
    const double share = allowed(level, band);
    double& log_theta = of.log_theta[level][band];
    log_theta += kAdaption * (share - (missed[level] ? 1.0 : 0.0));
    log_theta = std::clamp(log_theta, std::log(kMinLevel * share), std::log(kMaxLevel * share));
  }
}

void Calibration::refresh() {
  for (std::size_t k = 0; k < kClasses; ++k) {
    if (is_stale_[kCalibratedClasses[k].pool]) classes_[k].margins = margins(k, 1.0);
  }
  is_stale_.fill(false);
}

}  // namespace tern
