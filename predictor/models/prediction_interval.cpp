#include "predictor/models/prediction_interval.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace tern {
namespace {

constexpr double kMaxQuantile = 40.0;
constexpr int kHalvings = 36;  // of [0, kMaxQuantile]: to 1e-9

MotionSample sample_of(const Waypoint& waypoint) {
  MotionSample sample;
  sample.p = waypoint.centre;
  sample.v = waypoint.velocity;
  return sample;
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

double escape_quantile(double probability, double crossings) {
  double low = 0.0;
  double high = kMaxQuantile;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (escape_probability(middle, crossings) <= probability ? high : low) = middle;
  }
  return high;
}

void set_motion(const std::vector<Waypoint>& waypoints, const std::vector<Duration>& ends, UTime start, double speed,
                Track& track) {
  track.motion.start = start;
  track.motion.pieces.clear();
  track.alpha.clear();
  track.shares.clear();
  track.motion.pieces.reserve(ends.size() - 1);
  track.alpha.reserve(ends.size() - 1);
  track.shares.reserve(ends.size() - 1);
  track.top_speed = speed;
  std::array<Vec3, kConfidenceLevels.size()> largest = waypoints.front().half;
  for (std::size_t k = 1; k < ends.size(); ++k) {
    const Waypoint& to = waypoints[k];
    track.motion.pieces.push_back(hermite_piece(sample_of(waypoints[k - 1]), sample_of(to), ends[k] - ends[k - 1]));
    const Vec3 away = (to.centre - waypoints.front().centre).cwiseAbs();
    const Vec3 reach = away + Vec3::Constant(speed * ends[k].seconds());
    for (std::size_t level = 0; level < largest.size(); ++level) {
      const Vec3 half = to.half[level].cwiseMin(waypoints.front().half[level] + reach);
      largest[level] = largest[level].cwiseMax(half);
    }
    track.alpha.push_back(largest.front());
    AlphaShares shares{};
    for (std::size_t level = 0; level < shares.size(); ++level) {
      for (int axis = 0; axis < 3; ++axis) {
        const float before = level == 0 ? 1.0F : shares[level - 1][idx(axis)];
        shares[level][idx(axis)] = std::min(before, share_of(largest[level + 1][axis], largest.front()[axis]));
      }
    }
    track.shares.push_back(shares);
  }
}

}  // namespace tern
