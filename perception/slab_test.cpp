#include "perception/slab_test.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/geometry/box.h"

namespace tern {
namespace {

/// Smaller components of a ray count as this: their inverse stays finite, and a depth of 1 km moves by 0.1 mm.
constexpr float kLeastComponent = 1e-7F;
/// A corner nearer than this to the camera's plane has no place in the picture, m.
constexpr double kNearPlane = 1e-3;

using Corners = Eigen::Matrix<double, 3, 8>;

/// Clamps a coordinate of the picture to whole pixels that exist; far values do not overflow.
int pixel_below(double x, int count) { return static_cast<int>(std::clamp(std::floor(x), 0.0, count - 1.0)); }
int pixel_above(double x, int count) { return static_cast<int>(std::clamp(std::ceil(x), 0.0, count - 1.0)); }

std::optional<PixelRectangle> around_pinhole(const DepthSensor& sensor, const Corners& corners) {
  const PictureShape& shape = sensor.shape;
  const double nearest = corners.row(2).minCoeff();
  if (nearest > sensor.range_m || corners.row(2).maxCoeff() <= 0.0) return std::nullopt;
  if (nearest < kNearPlane) return PixelRectangle{0, shape.columns - 1, 0, shape.rows - 1};
  const Eigen::Array<double, 1, 8> u = corners.row(0).array() / corners.row(2).array() * shape.fx + shape.cx;
  const Eigen::Array<double, 1, 8> v = corners.row(1).array() / corners.row(2).array() * shape.fy + shape.cy;
  const bool beside = u.maxCoeff() < -0.5 || u.minCoeff() > shape.columns - 0.5 || v.maxCoeff() < -0.5 ||
                      v.minCoeff() > shape.rows - 0.5;
  if (beside) return std::nullopt;
  return PixelRectangle{pixel_below(u.minCoeff(), shape.columns), pixel_above(u.maxCoeff(), shape.columns),
                        pixel_below(v.minCoeff(), shape.rows), pixel_above(v.maxCoeff(), shape.rows)};
}

/// Columns of a box around its centre's azimuth; the corners bound its azimuth unless the axis y of C meets it.
void set_columns(const PictureShape& shape, const Corners& corners, const Vec3& centre, PixelRectangle& rectangle) {
  rectangle.first_column = 0;
  rectangle.last_column = shape.columns - 1;
  const double middle = std::atan2(centre.x(), centre.z());
  double least = 0.0, most = 0.0;
  for (int k = 0; k < 8; ++k) {
    const double azimuth = std::atan2(corners(0, k), corners(2, k));
    const double beside = std::remainder(azimuth - middle, 2.0 * std::numbers::pi);
    least = std::min(least, beside);
    most = std::max(most, beside);
  }
  if (most - least >= std::numbers::pi - 1e-9) return;
  const double first = std::floor(shape.cx + shape.fx * (middle + least));
  const double last = std::ceil(shape.cx + shape.fx * (middle + most));
  if (shape.wraps) {
    if (last - first + 1 >= shape.columns) return;
    rectangle.first_column = static_cast<int>(first);
    rectangle.last_column = static_cast<int>(last);
    return;
  }
  // Without wrapping, a box behind the sensor may straddle ±π: then all columns are tested.
  if (std::abs(middle + least) > std::numbers::pi || std::abs(middle + most) > std::numbers::pi) return;
  rectangle.first_column = static_cast<int>(std::max(first, 0.0));
  rectangle.last_column = static_cast<int>(std::min(last, shape.columns - 1.0));
}

std::optional<PixelRectangle> around_spherical(const DepthSensor& sensor, const Corners& corners, const Vec3& centre) {
  const PictureShape& shape = sensor.shape;
  PixelRectangle rectangle{};
  set_columns(shape, corners, centre, rectangle);
  if (rectangle.first_column > rectangle.last_column) return std::nullopt;
  // The angle below the horizon of any point lies between those of its height range at its range of distances.
  double radius = 0.0;
  for (int k = 0; k < 8; ++k) {
    radius = std::max(radius, std::hypot(corners(0, k) - centre.x(), corners(2, k) - centre.z()));
  }
  const double along = std::hypot(centre.x(), centre.z());
  const double near = std::max(along - radius, 0.0), far = along + radius;
  const double highest = corners.row(1).minCoeff(), lowest = corners.row(1).maxCoeff();  // y points down
  const double top = std::atan2(highest, highest < 0.0 ? near : far);
  const double bottom = std::atan2(lowest, lowest > 0.0 ? near : far);
  const double first = shape.cy + shape.fy * top, last = shape.cy + shape.fy * bottom;
  if (last < -0.5 || first > shape.rows - 0.5) return std::nullopt;
  rectangle.first_row = pixel_below(first, shape.rows);
  rectangle.last_row = pixel_above(last, shape.rows);
  return rectangle;
}

}  // namespace

std::optional<PixelRectangle> pixels_around(const DepthPicture& picture, const Box& box) {
  const DepthSensor& sensor = picture.sensor();
  const SensorPose& pose = picture.pose();
  if (sensor.shape.kind == PictureKind::Spherical && box.exteriorDistance(pose.position) > sensor.range_m) {
    return std::nullopt;
  }
  const Eigen::Matrix3d R_CW = pose.q_WC.conjugate().toRotationMatrix();
  const Corners corners = R_CW * (box_corners(box).colwise() - pose.position);
  if (sensor.shape.kind == PictureKind::Pinhole) return around_pinhole(sensor, corners);
  return around_spherical(sensor, corners, R_CW * (box.center() - pose.position));
}

void SlabTest::prepare(const DepthPicture& picture) {
  inverse_ = picture.rays_W();
  float* const values = inverse_.data();
  for (Eigen::Index k = 0; k < inverse_.size(); ++k) {
    const float d = values[k];
    values[k] = 1.0F / (std::abs(d) < kLeastComponent ? std::copysign(kLeastComponent, d) : d);
  }
  enter_.resize(picture.shape().columns);
  leave_.resize(picture.shape().columns);
}

void SlabTest::test(int first_pixel, int count, const Eigen::Array3f& low, const Eigen::Array3f& high) {
  const auto x = inverse_.col(0).segment(first_pixel, count);
  const auto y = inverse_.col(1).segment(first_pixel, count);
  const auto z = inverse_.col(2).segment(first_pixel, count);
  enter_.head(count) =
      (x * low[0]).min(x * high[0]).max((y * low[1]).min(y * high[1])).max((z * low[2]).min(z * high[2]));
  leave_.head(count) =
      (x * low[0]).max(x * high[0]).min((y * low[1]).max(y * high[1])).min((z * low[2]).max(z * high[2]));
}

}  // namespace tern
