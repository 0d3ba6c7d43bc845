#include "predictor/models/constant_velocity.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tern {
namespace {

// Simpson's nodes of crossing_integral: relative error below 1e-3 against adaptive quadrature (see its test).
constexpr int kSimpsonIntervals = 48;
// Halvings of [0, kLargestQuantile]: to 1e-9.
constexpr double kLargestQuantile = 40.0;
constexpr int kHalvings = 36;

double crossing_rate(const AxisFilter& start, double q, double t) {
  AxisFilter p = start;
  p.predict(t, q);
  return std::sqrt(std::max(0.0, p.xx * p.vv - p.xv * p.xv)) / p.xx;
}

}  // namespace

std::vector<Duration> piece_ends(const PredictionSpec& spec) {
  std::vector<Duration> ends{Duration{}};
  while (ends.back() < spec.horizon) {
    const Duration length = std::max(spec.piece, Duration{ends.back().us / 4});
    ends.push_back(std::min(ends.back() + length, spec.horizon));
  }
  return ends;
}

double escape_probability(double z, double crossings) {
  return std::erfc(z / std::numbers::sqrt2) + std::exp(-0.5 * z * z) * crossings / std::numbers::pi;
}

double crossing_integral(const AxisFilter& filter, double q, double horizon_s) {
  double sum = 0.0;
  for (int i = 1; i <= kSimpsonIntervals; ++i) {  // at u = 0 dt/du = 0
    const double u = static_cast<double>(i) / kSimpsonIntervals;
    const double weight = i == kSimpsonIntervals ? 1.0 : (i % 2 == 1 ? 4.0 : 2.0);
    sum += weight * crossing_rate(filter, q, horizon_s * u * u * u) * 3.0 * horizon_s * u * u;
  }
  return sum / (3.0 * kSimpsonIntervals);
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

AxisTube axis_tube(const AxisFilter& filter, double q, double probability, const PredictionSpec& spec) {
  const double z = quantile_for(probability, crossing_integral(filter, q, spec.horizon.seconds()));
  const double speed = std::max(spec.max_speed, std::abs(filter.v));
  AxisTube tube;
  double low = 0.0, high = 0.0, before = 0.0;
  for (const Duration end : piece_ends(spec)) {
    const double t = end.seconds();
    AxisFilter at = filter;
    at.predict(t, q);
    const double reach = z * std::sqrt(at.xx);
    const bool first = end == Duration{};
    high = first ? at.x + reach : std::min(at.x + reach, high + speed * (t - before));
    low = first ? at.x - reach : std::max(at.x - reach, low - speed * (t - before));
    tube.centre.push_back(0.5 * (low + high));
    tube.half.push_back(0.5 * (high - low));
    before = t;
  }
  return tube;
}

void predict_motion(const std::array<AxisFilter, 3>& axes, double q, UTime start, const PredictionSpec& spec,
                    Track& track) {
  const std::vector<Duration> ends = piece_ends(spec);
  const std::size_t pieces = ends.size() - 1;
  track.motion.start = start;
  track.motion.pieces.assign(pieces, CubicPiece{});
  track.alpha.assign(pieces, Vec3::Zero());
  track.top_speed = spec.max_speed;
  for (int axis = 0; axis < 3; ++axis) {
    const AxisFilter& filter = axes[static_cast<std::size_t>(axis)];
    const AxisTube tube = axis_tube(filter, q, (1.0 - spec.confidence) / 3.0, spec);
    track.top_speed = std::max(track.top_speed, std::abs(filter.v));
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
