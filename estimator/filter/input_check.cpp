#include "estimator/filter/input_check.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace tern {
namespace {

constexpr double kMaxRate = 1e3;         ///< rad/s: beyond any gyroscope
constexpr double kMaxForce = 1e5;        ///< m/s²: beyond any accelerometer
constexpr double kMaxTangent = 20.0;     ///< of the angle to the optical axis: 87°
constexpr double kUnitTolerance = 1e-3;  ///< of a quaternion's norm
constexpr double kMaxPlace = 1e7;        ///< m
constexpr double kSwapSigmas = 5.0;      ///< a mean disparity this far below zero is not noise
constexpr double kSwapShare = 0.75;      ///< of the disparities: a few wrong matches are not swapped cameras
constexpr int kLeastForSwap = 8;

bool is_sane(const Vec3& x, double limit) { return x.allFinite() && x.cwiseAbs().maxCoeff() <= limit; }

bool is_sane(const Eigen::Vector2d& x) { return x.allFinite() && x.cwiseAbs().maxCoeff() <= kMaxTangent; }

bool has_usable_camera(const FeatureFrame& frame) {
  return is_sane(frame.p_BC, kMaxPlace) && std::abs(frame.q_BC.norm() - 1.0) < kUnitTolerance &&
         std::isfinite(frame.baseline_m) && frame.baseline_m > 0.0 && std::isfinite(frame.sigma) && frame.sigma > 0.0;
}

/// Whether the disparities are negative beyond their noise, as a mean and most of them one by one.
bool is_swapped(const FeatureFrame& frame) {
  int pairs = 0, negative = 0;
  double sum = 0.0;
  for (const StereoFeature& feature : frame.features) {
    if (!feature.has_right) continue;
    const double disparity = feature.left.x() - feature.right.x();
    ++pairs;
    sum += disparity;
    if (disparity < 0.0) ++negative;
  }
  if (pairs < kLeastForSwap || negative < kSwapShare * pairs) return false;
  return sum / pairs < -kSwapSigmas * frame.sigma * std::sqrt(2.0 / pairs);
}

}  // namespace

bool is_usable(const ImuSample& sample) {
  return is_sane(sample.angular_velocity, kMaxRate) && is_sane(sample.specific_force, kMaxForce);
}

bool is_usable(const PositionFix& fix) {
  return is_sane(fix.position, kMaxPlace) && fix.variance.allFinite() && (fix.variance.array() > 0.0).all() &&
         (!fix.has_yaw || (std::isfinite(fix.yaw) && std::isfinite(fix.yaw_variance) && fix.yaw_variance > 0.0));
}

CheckedFrame checked(FeatureFrame frame) {
  CheckedFrame out;
  if (!has_usable_camera(frame)) {
    out.refused = true;
    out.troubles.push_back(Trouble::FrameNotFinite);
    return out;
  }
  const auto not_finite = std::erase_if(frame.features, [](const StereoFeature& feature) {
    return !is_sane(feature.left) || (feature.has_right && !is_sane(feature.right));
  });
  if (not_finite > 0) out.troubles.push_back(Trouble::FrameNotFinite);
  std::set<std::int64_t> ids;
  const auto repeated =
      std::erase_if(frame.features, [&ids](const StereoFeature& feature) { return !ids.insert(feature.id).second; });
  if (repeated > 0) out.troubles.push_back(Trouble::RepeatedIds);
  if (is_swapped(frame)) {
    out.refused = true;
    out.troubles.push_back(Trouble::CamerasSwapped);
  }
  out.frame = std::move(frame);
  return out;
}

bool is_same_image(const FeatureFrame& a, const FeatureFrame& b) {
  if (a.features.size() != b.features.size() || a.features.size() < idx(kLeastForStuck)) return false;
  return std::equal(a.features.begin(), a.features.end(), b.features.begin(),
                    [](const StereoFeature& x, const StereoFeature& y) { return x.id == y.id && x.left == y.left; });
}

}  // namespace tern
