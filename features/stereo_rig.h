// Two calibrated cameras on the vehicle, and the rectified pair that FEATURE_TRACKS is about.
#pragma once

#include <optional>

#include "core/base/result.h"
#include "core/base/types.h"
#include "features/camera_model.h"

namespace tern {

/// A camera with its place on the vehicle.
struct MountedCamera {
  CameraModel model;
  Eigen::Matrix3d R_BC = Eigen::Matrix3d::Identity();  ///< from the camera to the body B
  Vec3 p_BC = Vec3::Zero();                            ///< of the camera in B, m
};

/// A stereo pair. Its rectified left camera C is at the left camera's place. C's x points to the right camera, and its
/// z is the mean of both optical axes, made perpendicular to x. Images are not resampled: coordinates of single pixels
/// are undistorted and turned.
class StereoRig {
 public:
  /// Fails if the right camera is not to the right of the left one, or if their optical axes differ by more than 45°.
  static Result<StereoRig> make(const MountedCamera& left, const MountedCamera& right);

  /// Returns x/z, y/z of a pixel in the rectified left (right) camera. nullopt: beyond the lens's model, or farther
  /// than kWidest from the axis.
  [[nodiscard]] std::optional<Eigen::Vector2d> left_coordinates(const Eigen::Vector2d& pixel) const;
  [[nodiscard]] std::optional<Eigen::Vector2d> right_coordinates(const Eigen::Vector2d& pixel) const;
  /// Returns the pixel in the right image at rectified right coordinates.
  [[nodiscard]] std::optional<Eigen::Vector2d> right_pixel(const Eigen::Vector2d& coordinates) const;

  [[nodiscard]] const MountedCamera& left() const { return left_; }
  [[nodiscard]] const MountedCamera& right() const { return right_; }
  [[nodiscard]] const Eigen::Matrix3d& R_BC() const { return R_BC_; }  ///< from C to B
  [[nodiscard]] double baseline() const { return baseline_; }          ///< m, > 0
  /// The mean focal length of the left camera, pixels.
  [[nodiscard]] double focal() const { return 0.5 * (left_.model.fx + left_.model.fy); }

  /// Largest norm of coordinates: 50° from the axis. There a pixel of an equidistant lens spans 2.4 times as much of
  /// them as in the centre. FEATURE_TRACKS states one σ for all.
  static constexpr double kWidest = 1.2;

 private:
  StereoRig() = default;
  MountedCamera left_, right_;
  Eigen::Matrix3d R_BC_ = Eigen::Matrix3d::Identity();
  double baseline_ = 0.0;
};

}  // namespace tern
