#include "features/stereo_rig.h"

#include <fmt/format.h>

namespace tern {
namespace {

using Eigen::Vector2d;

constexpr double kMostTurned = 0.7071;  ///< cosine of 45°

/// Turns coordinates of a camera into those of the rectified one.
std::optional<Vector2d> turned(const Eigen::Matrix3d& R, const std::optional<Vector2d>& at) {
  if (!at) return std::nullopt;
  const Vec3 direction = R * Vec3(at->x(), at->y(), 1.0);
  if (!(direction.z() > 0.0)) return std::nullopt;
  const Vector2d turned_at = direction.head<2>() / direction.z();
  if (turned_at.norm() > StereoRig::kWidest) return std::nullopt;
  return turned_at;
}

}  // namespace

Result<StereoRig> StereoRig::make(const MountedCamera& left, const MountedCamera& right) {
  StereoRig rig;
  rig.left_ = left;
  rig.right_ = right;
  const Vec3 offset = right.p_BC - left.p_BC;
  rig.baseline_ = offset.norm();
  if (!(rig.baseline_ > 0.0)) return fail("both cameras are at the same place");
  const Vec3 x = offset / rig.baseline_;
  const double along = x.dot(left.R_BC.col(0));
  if (!(along > kMostTurned)) {
    return fail(
        fmt::format("the right camera is not to the right of the left one: the offset of {:.3f} m has the "
                    "cosine {:.2f} with the left camera's x axis. Are the cameras exchanged?",
                    rig.baseline_, along));
  }
  const double aligned = left.R_BC.col(2).dot(right.R_BC.col(2));
  if (!(aligned > kMostTurned)) return fail("the optical axes of the cameras differ by more than 45°");
  const Vec3 mean = left.R_BC.col(2) + right.R_BC.col(2);
  const Vec3 z = (mean - mean.dot(x) * x).normalized();
  rig.R_BC_ << x, z.cross(x), z;
  return rig;
}

std::optional<Vector2d> StereoRig::left_coordinates(const Vector2d& pixel) const {
  return turned(R_BC_.transpose() * left_.R_BC, left_.model.coordinates_of(pixel));
}

std::optional<Vector2d> StereoRig::right_coordinates(const Vector2d& pixel) const {
  return turned(R_BC_.transpose() * right_.R_BC, right_.model.coordinates_of(pixel));
}

std::optional<Vector2d> StereoRig::right_pixel(const Vector2d& coordinates) const {
  return right_.model.pixel_of(right_.R_BC.transpose() * R_BC_ * Vec3(coordinates.x(), coordinates.y(), 1.0));
}

}  // namespace tern
