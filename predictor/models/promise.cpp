#include "predictor/models/promise.h"

#include <algorithm>
#include <cmath>

namespace tern {
namespace {

// Halvings of [0, kLargestQuantile]: to 1e-9.
constexpr double kLargestQuantile = 40.0;
constexpr int kHalvings = 36;
constexpr std::size_t kLowerLevels = kConfidenceLevels.size() - 1;

/// Where the axis is at a lower level, as a share of α about the promised centre line, if that is more than the share.
void raise_shares(const AxisTube& promised, const AxisTube& lower, std::size_t level,
                  std::vector<AlphaShares>& shares) {
  const auto shift = [&](std::size_t k) { return std::abs(lower.centre[k] - promised.centre[k]); };
  for (std::size_t k = 0; k < shares.size(); ++k) {
    const double half = lower.half[k + 1] + std::max(shift(k), shift(k + 1));
    const auto share = static_cast<float>(std::min(1.0, half / promised.half[k + 1]));
    for (std::size_t l = 0; l <= level; ++l) shares[k][l] = std::max(shares[k][l], share);
  }
}

}  // namespace

std::vector<Duration> piece_ends(const PredictionSpec& spec) {
  std::vector<Duration> ends{Duration{}};
  while (ends.back() < spec.horizon) {
    const Duration length = std::max(spec.piece, Duration::from_seconds(spec.piece_growth * ends.back().seconds()));
    ends.push_back(std::min(ends.back() + length, spec.horizon));
  }
  return ends;
}

double escape_probability(double z, double crossings) {
  return std::erfc(z / std::numbers::sqrt2) + std::exp(-0.5 * z * z) * crossings / std::numbers::pi;
}

double quantile_for(double probability, double crossings) {
  double low = 0.0;
  double high = kLargestQuantile;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (escape_probability(middle, crossings) <= probability ? high : low) = middle;
  }
  return high;
}

AxisTube axis_tube(const AxisForecast& forecast, double probability, const PredictionSpec& spec) {
  const double z = quantile_for(probability, forecast.crossings);
  const double speed = std::max(spec.max_speed, forecast.speed);
  const std::vector<Duration> ends = piece_ends(spec);
  AxisTube tube;
  double low = 0.0, high = 0.0;
  for (std::size_t k = 0; k < ends.size(); ++k) {
    const double reach = z * forecast.sigma[k];
    const double step = k == 0 ? 0.0 : (ends[k] - ends[k - 1]).seconds();
    high = k == 0 ? forecast.mean[k] + reach : std::min(forecast.mean[k] + reach, high + speed * step);
    low = k == 0 ? forecast.mean[k] - reach : std::max(forecast.mean[k] - reach, low - speed * step);
    tube.centre.push_back(0.5 * (low + high));
    const double half = 0.5 * (high - low) + forecast.max_curvature * step * step / 8.0;
    tube.half.push_back(k == 0 ? half : std::max(half, tube.half.back()));
  }
  return tube;
}

void predict_motion(const std::array<AxisForecast, 3>& axes, UTime start, const PredictionSpec& spec, Track& track) {
  const std::vector<Duration> ends = piece_ends(spec);
  const std::size_t pieces = ends.size() - 1;
  track.motion.start = start;
  track.motion.pieces.assign(pieces, CubicPiece{});
  track.alpha.assign(pieces, Vec3::Zero());
  track.shares.assign(pieces, AlphaShares{});
  track.top_speed = spec.max_speed;
  for (int axis = 0; axis < 3; ++axis) {
    const AxisForecast& forecast = axes[static_cast<std::size_t>(axis)];
    const AxisTube tube = axis_tube(forecast, (1.0 - spec.confidence) / 3.0, spec);
    for (std::size_t level = 0; level < kLowerLevels; ++level) {
      const double confidence = confidence_at(spec.confidence, static_cast<int>(level) + 1);
      raise_shares(tube, axis_tube(forecast, (1.0 - confidence) / 3.0, spec), level, track.shares);
    }
    track.top_speed = std::max(track.top_speed, forecast.speed);
    for (std::size_t k = 0; k < pieces; ++k) {
      CubicPiece& piece = track.motion.pieces[k];
      piece.duration = ends[k + 1] - ends[k];
      piece.coefficients(axis, 2) = (tube.centre[k + 1] - tube.centre[k]) / piece.duration.seconds();
      piece.coefficients(axis, 3) = tube.centre[k];
      track.alpha[k][axis] = tube.half[k + 1];
    }
  }
}

}  // namespace tern
