#include "predictor/tracking/scored_interval.h"

#include <algorithm>

namespace tern {

ScoredInterval::ScoredInterval(TrackClass of, const Calibration& calibration)
    : margins_(calibration.margins(of)), scene_speed_(calibration.scene_speed()) {
  scored_.of = of;
  half_width_.fill(Vec3::Zero());
}

void ScoredInterval::add(const Vec3& error, const Vec3& deviation, double score, double ahead_s) {
  const std::size_t band = band_of(ahead_s);
  score_ = std::max(score_, score);
  for (std::size_t level = 0; level < margins_.size(); ++level) {
    half_width_[level] = half_width_[level].cwiseMax(interval_half_width(deviation, margins_[level], ahead_s));
    const bool is_outside = (error.array() > half_width_[level].array()).any() && score > margins_[level][band];
    missed_[level] = missed_[level] || is_outside;
  }
}

void ScoredInterval::end_band(std::size_t band, Calibration& calibration) {
  const auto score = static_cast<float>(score_);
  calibration.add(scored_.of, band, score, missed_, scene_speed_);
  scored_.scores[band] = score;
  scored_.bands = band + 1;
  score_ = -kModelSigmas;
}

}  // namespace tern
