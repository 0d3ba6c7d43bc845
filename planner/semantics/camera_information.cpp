#include "planner/semantics/camera_information.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "planner/semantics/drift.h"

namespace tern {
namespace {

/// Information about a frame's motion where nothing is seen: 30 m and 3 rad. It keeps matrices regular.
constexpr double kNoTranslation = 1.0 / (30.0 * 30.0);
constexpr double kNoRotation = 1.0 / (3.0 * 3.0);

}  // namespace

void ViewInformation::add(const Vec3& displacement, double count, const TextureCamera& camera) {
  const double r2 = displacement.squaredNorm();
  const double across = count * camera.focal_px * camera.focal_px / (2.0 * r2);
  const double along =
      count * camera.focal_px * camera.focal_px * camera.baseline_m * camera.baseline_m / (4.0 * r2 * r2);
  const Eigen::Matrix3d W =
      across * Eigen::Matrix3d::Identity() + ((along - across) / r2) * displacement * displacement.transpose();
  Eigen::Matrix3d X;  // −[x]×
  X << 0.0, displacement.z(), -displacement.y(), -displacement.z(), 0.0, displacement.x(), displacement.y(),
      -displacement.x(), 0.0;
  const Eigen::Matrix3d WX = W * X;
  information.topLeftCorner<3, 3>() += X.transpose() * WX;
  information.bottomLeftCorner<3, 3>() += WX;
  information.topRightCorner<3, 3>() += WX.transpose();
  information.bottomRightCorner<3, 3>() += W;
  landmarks += count;
}

ViewInformation& ViewInformation::operator+=(const ViewInformation& other) {
  information += other.information;
  landmarks += other.landmarks;
  return *this;
}

FrameSigma frame_sigma(const ViewInformation& view, const TextureCamera& camera) {
  const double n = view.landmarks;
  const double at_least_three = 1.0 - std::exp(-n) * (1.0 + n + 0.5 * n * n);
  const double share = std::min(1.0, camera.most_tracks / std::max(n, 1e-9)) * at_least_three;
  Mat6 information = share * view.information;
  information.diagonal().head<3>().array() += kNoRotation;
  information.diagonal().tail<3>().array() += kNoTranslation;
  const Mat6 alone = information.llt().solve(Mat6::Identity());
  const double gyroscope = 1.0 / (kFlightNoise.rate * kFlightNoise.rate * camera.frame_s);
  information.diagonal().head<3>().array() += gyroscope;
  const Mat6 helped = information.llt().solve(Mat6::Identity());
  return {std::sqrt(helped.bottomRightCorner<3, 3>().trace()), std::sqrt(alone.topLeftCorner<3, 3>().trace() / 3.0)};
}

}  // namespace tern
