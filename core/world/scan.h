// The messages POINT_CLOUD and DEPTH_IMAGE: surfaces as sensors measure them.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/types.h"
#include "core/wire/header.h"

namespace tern {

/// A point on a surface.
struct CloudPoint {
  Eigen::Vector3f position = Eigen::Vector3f::Zero();  ///< from the sensor, axes of W, m; NaN: no measurement
  std::uint8_t class_number = 0;                       ///< with CloudScan::has_classes
};

/// POINT_CLOUD: points that one sensor measured at one time, or a part of them. Messages of one sensor with the same
/// `at` are one scan.
struct CloudScan {
  Header header;
  UTime at;  ///< when the sensor measured, vehicle's clock
  std::int32_t sensor_id = 0;
  double range_m = 0.0;                 ///< points farther away are free space up to the range, m; 0: unlimited
  Vec3 sensor_position = Vec3::Zero();  ///< W, m
  bool has_classes = false;
  std::vector<CloudPoint> points;
};
inline constexpr int kMaxCloudPointsPerMessage = 4'000;

/// DEPTH_IMAGE: distances along the optical axis, as a pinhole camera measures them, or some rows of them. The camera
/// frame C has x to the right, y down and z forward. Pixel (u, v) of depth z lies at z·((u − cx)/fx, (v − cy)/fy, 1).
struct DepthImage {
  Header header;
  UTime at;  ///< when the camera measured, vehicle's clock
  std::int32_t sensor_id = 0;
  double range_m = 0.0;                 ///< points farther away are free space up to the range, m; 0: unlimited
  Vec3 sensor_position = Vec3::Zero();  ///< W, m
  Eigen::Vector4d q_WC{1, 0, 0, 0};     ///< w, x, y, z of the unit quaternion that turns C into W
  double fx = 1.0, fy = 1.0;            ///< focal lengths, pixels, > 0
  double cx = 0.0, cy = 0.0;            ///< principal point of the whole image, pixels
  double unit_m = 0.001;                ///< of the depths, m, > 0
  std::int32_t width = 1;               ///< pixels per row
  std::int32_t first_row = 0;           ///< row v of the first depths
  std::vector<std::int16_t> depths;     ///< row by row, in units; ≤ 0: no measurement
};
inline constexpr int kMaxDepthsPerMessage = 28'800;

}  // namespace tern
