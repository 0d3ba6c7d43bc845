#include "estimator/masks.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tern {
namespace {

/// The distance along the ray at which it enters the box; infinity if it never does.
double entry(const Vec3& from, const Vec3& direction, const Box& box) {
  double near = 0.0, far = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    const double low = box.min()[axis] - from[axis], high = box.max()[axis] - from[axis], d = direction[axis];
    if (d == 0.0) {
      if (low > 0.0 || high < 0.0) return std::numeric_limits<double>::infinity();
      continue;
    }
    near = std::max(near, std::min(low / d, high / d));
    far = std::min(far, std::max(low / d, high / d));
  }
  return near <= far ? near : std::numeric_limits<double>::infinity();
}

}  // namespace

bool may_lie_on(const FeatureFrame& frame, const StereoFeature& feature, const PoseInW& pose, const Box& box_W) {
  const Eigen::Quaterniond q_BC(frame.q_BC[0], frame.q_BC[1], frame.q_BC[2], frame.q_BC[3]);
  const Vec3 centre = pose.p + pose.R * frame.p_BC;
  if (box_W.contains(centre)) return false;
  const Vec3 ray = pose.R * (q_BC.normalized() * feature.left.homogeneous());  // of depth 1
  const double depth_of_box = entry(centre, ray, box_W);
  if (!std::isfinite(depth_of_box)) return false;
  if (!feature.has_right) return true;
  // The least disparity that the noise allows gives the largest depth.
  const double disparity = feature.left.x() - feature.right.x() - 3.0 * std::sqrt(2.0) * frame.sigma;
  return disparity <= 0.0 || frame.baseline_m / disparity >= depth_of_box;
}

FeatureFrame unmasked(FeatureFrame frame, const Masks& masks, const PoseInW& pose) {
  std::erase_if(frame.features, [&](const StereoFeature& feature) {
    return std::ranges::any_of(masks.image, [&](const auto& part) { return part.contains(feature.left); }) ||
           std::ranges::any_of(masks.boxes_W, [&](const Box& box) { return may_lie_on(frame, feature, pose, box); });
  });
  return frame;
}

}  // namespace tern
