// A depth picture: what a camera or a lidar measured at one time, a distance per pixel.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "core/base/types.h"

namespace tern {

/// The sensor's frame C has x to the right, y down and z forward.
///
/// | kind      | ray d of pixel (u, v), a = (u − cx)/fx, b = (v − cy)/fy | its depth            |
/// |-----------|---------------------------------------------------------|----------------------|
/// | Pinhole   | (a, b, 1)                                               | along the axis z, m  |
/// | Spherical | (cos b sin a, sin b, cos b cos a), b down               | distance, m          |
///
/// In both kinds a point is eye + depth · d. Pixel centres are whole numbers u, v.
enum class PictureKind : std::uint8_t { Pinhole, Spherical };

/// Which rays a picture has.
struct PictureShape {
  PictureKind kind = PictureKind::Pinhole;
  int columns = 0, rows = 0;  ///< ≥ 1
  double fx = 1.0, fy = 1.0;  ///< pixels per unit tangent (Pinhole) or per radian (Spherical), > 0
  double cx = 0.0, cy = 0.0;  ///< pixel on the axis z
  bool wraps = false;         ///< Spherical over 360°: the last column is beside the first one

  [[nodiscard]] int pixels() const { return columns * rows; }
  /// Returns the size of a pixel at depth 1, m: the larger of both directions, on the axis.
  [[nodiscard]] double pixel_size() const { return 1.0 / (fx < fy ? fx : fy); }
  /// Returns the ray of pixel (u, v) in C, scaled to depth 1.
  [[nodiscard]] Vec3 ray(double u, double v) const;
};

/// Returns the shape of a camera whose axis is the picture's middle. @pre fields of view in (0, π), rad
PictureShape camera_shape(double horizontal_fov, double vertical_fov, int columns, int rows);
/// Returns the shape of a lidar with equal steps of angle, rad. Elevations are positive upwards; an azimuth_fov of 2π
/// wraps.
PictureShape lidar_shape(double azimuth_fov, double elevation_min, double elevation_max, int columns, int rows);

/// The noise of depths: standard deviation σ(z) = constant_m + per_m · z². All pixels of a block × block square share
/// the noise of a stereo camera (spatial correlation in the RealSense data sheet).
struct DepthNoise {
  double constant_m = 0.0;  ///< m, ≥ 0
  double per_m = 0.0;       ///< 1/m, ≥ 0
  int block = 1;            ///< pixels, ≥ 1; 1: white

  [[nodiscard]] float sigma(float z) const {
    return static_cast<float>(constant_m) + static_cast<float>(per_m) * z * z;
  }
};

/// A sensor as its data sheet describes it.
struct DepthSensor {
  PictureShape shape;
  double least_range_m = 0.2;  ///< nearer depths are not measured, m, ≥ 0
  double range_m = 10.0;       ///< farther depths are `no return`, m, > least_range_m
  DepthNoise noise;
};

/// Where a sensor is: its place and the rotation from C to W.
struct SensorPose {
  Vec3 position = Vec3::Zero();  ///< W, m
  Eigen::Quaterniond q_WC = Eigen::Quaterniond::Identity();
};

/// Returns the pose of a sensor that looks along `yaw` (about W's z from W's x, rad), `pitch` above the horizon, level.
SensorPose looking(const Vec3& position, double yaw, double pitch = 0.0);

/// The depth of a pixel that measured nothing: too near, saturated or invalid. It says nothing about free space.
inline constexpr float kNotMeasured = 0.0F;

/// A pixel's place in a picture, and the depth of the point there.
struct PicturePoint {
  double u, v;   ///< pixels; pixel (i, j) has |u − i| ≤ ½, |v − j| ≤ ½
  double depth;  ///< as of the picture's kind, m
};

/// The rays of one sensor; pictures share them.
class RayGrid {
 public:
  /// @throws std::invalid_argument for a shape or ranges outside the stated limits
  explicit RayGrid(const DepthSensor& sensor);

  [[nodiscard]] const DepthSensor& sensor() const { return sensor_; }
  [[nodiscard]] const PictureShape& shape() const { return sensor_.shape; }
  /// Rays in C, one per row, scaled to depth 1. Pixel (u, v) is row v·columns + u.
  [[nodiscard]] const Eigen::ArrayX3f& rays() const { return rays_; }

 private:
  DepthSensor sensor_;
  Eigen::ArrayX3f rays_;
};

/// A depth per pixel, and the rays in W. The picture may be reused: move_to() keeps its memory.
class DepthPicture {
 public:
  /// A picture at the origin without a return.
  explicit DepthPicture(std::shared_ptr<const RayGrid> grid);

  /// Sets the pose and keeps the depths: a picture of the true world then lies at the believed pose. O(pixels).
  void set_pose(const SensorPose& pose);
  /// Sets the pose, and every depth to `no return`.
  void move_to(const SensorPose& pose);

  [[nodiscard]] const RayGrid& grid() const { return *grid_; }
  [[nodiscard]] const DepthSensor& sensor() const { return grid_->sensor(); }
  [[nodiscard]] const PictureShape& shape() const { return grid_->shape(); }
  [[nodiscard]] const SensorPose& pose() const { return pose_; }
  [[nodiscard]] float range() const { return static_cast<float>(sensor().range_m); }

  /// Depths by v·columns + u, m. kNotMeasured: nothing was measured. ≥ range(): no return, so free up to the range.
  [[nodiscard]] const Eigen::ArrayXf& depths() const { return depths_; }
  [[nodiscard]] Eigen::ArrayXf& depths() { return depths_; }
  /// Rays in W, one per row, scaled to depth 1.
  [[nodiscard]] const Eigen::ArrayX3f& rays_W() const { return rays_W_; }
  /// Returns the point of a pixel at a depth, from the sensor, axes of W, m.
  [[nodiscard]] Eigen::Vector3f at_depth(int pixel, float depth) const {
    return {rays_W_(pixel, 0) * depth, rays_W_(pixel, 1) * depth, rays_W_(pixel, 2) * depth};
  }
  /// Whether a surface was measured at a pixel.
  [[nodiscard]] bool is_surface(int pixel) const { return depths_[pixel] > kNotMeasured && depths_[pixel] < range(); }
  /// Returns where a point of W lies in the picture; nullopt outside it.
  [[nodiscard]] std::optional<PicturePoint> place_of(const Vec3& p_W) const;

 private:
  std::shared_ptr<const RayGrid> grid_;
  SensorPose pose_;
  Eigen::ArrayXf depths_;
  Eigen::ArrayX3f rays_W_;
};

/// Returns where a point of C lies for a shape; nullopt outside it. The depth of a point behind a camera is ≤ 0.
std::optional<PicturePoint> place_in(const PictureShape& shape, const Vec3& p_C);

}  // namespace tern
