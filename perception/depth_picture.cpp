#include "perception/depth_picture.h"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

namespace tern {
namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;
/// An azimuth field of view this near to 2π closes the circle, rad.
constexpr double kFullCircle = 1e-6;

void require(bool holds, const char* what, double value) {
  if (!holds) throw std::invalid_argument(std::string("depth sensor: ") + what + " " + std::to_string(value));
}

DepthSensor checked(const DepthSensor& sensor) {
  const PictureShape& shape = sensor.shape;
  require(shape.columns >= 1, "columns below 1:", shape.columns);
  require(shape.rows >= 1, "rows below 1:", shape.rows);
  require(shape.fx > 0.0, "fx is not positive:", shape.fx);
  require(shape.fy > 0.0, "fy is not positive:", shape.fy);
  require(sensor.least_range_m >= 0.0, "least_range_m negative:", sensor.least_range_m);
  require(sensor.range_m > sensor.least_range_m, "range_m not above least_range_m:", sensor.range_m);
  require(sensor.noise.constant_m >= 0.0, "constant_m negative:", sensor.noise.constant_m);
  require(sensor.noise.per_m >= 0.0, "per_m negative:", sensor.noise.per_m);
  require(sensor.noise.block >= 1, "block below 1:", sensor.noise.block);
  return sensor;
}

}  // namespace

Vec3 PictureShape::ray(double u, double v) const {
  const double a = (u - cx) / fx;
  const double b = (v - cy) / fy;
  if (kind == PictureKind::Pinhole) return {a, b, 1.0};
  return {std::cos(b) * std::sin(a), std::sin(b), std::cos(b) * std::cos(a)};
}

PictureShape camera_shape(double horizontal_fov, double vertical_fov, int columns, int rows) {
  PictureShape shape;
  shape.columns = columns;
  shape.rows = rows;
  shape.fx = 0.5 * columns / std::tan(0.5 * horizontal_fov);
  shape.fy = 0.5 * rows / std::tan(0.5 * vertical_fov);
  shape.cx = 0.5 * (columns - 1);
  shape.cy = 0.5 * (rows - 1);
  return shape;
}

PictureShape lidar_shape(double azimuth_fov, double elevation_min, double elevation_max, int columns, int rows) {
  PictureShape shape;
  shape.kind = PictureKind::Spherical;
  shape.columns = columns;
  shape.rows = rows;
  shape.fx = columns / azimuth_fov;
  shape.fy = rows / (elevation_max - elevation_min);
  shape.cx = 0.5 * (columns - 1);
  shape.cy = elevation_max * shape.fy - 0.5;
  shape.wraps = azimuth_fov > kTwoPi - kFullCircle;
  return shape;
}

SensorPose looking(const Vec3& position, double yaw, double pitch) {
  const Vec3 forward(std::cos(yaw) * std::cos(pitch), std::sin(yaw) * std::cos(pitch), std::sin(pitch));
  const Vec3 right(std::sin(yaw), -std::cos(yaw), 0.0);
  Eigen::Matrix3d R_WC;
  R_WC << right, forward.cross(right), forward;
  return {position, Eigen::Quaterniond(R_WC)};
}

std::optional<PicturePoint> place_in(const PictureShape& shape, const Vec3& p_C) {
  PicturePoint place{};
  if (shape.kind == PictureKind::Pinhole) {
    if (p_C.z() <= 0.0) return std::nullopt;
    place = {shape.cx + shape.fx * p_C.x() / p_C.z(), shape.cy + shape.fy * p_C.y() / p_C.z(), p_C.z()};
  } else {
    const double azimuth = std::atan2(p_C.x(), p_C.z());
    const double down = std::atan2(p_C.y(), std::hypot(p_C.x(), p_C.z()));
    place = {shape.cx + shape.fx * azimuth, shape.cy + shape.fy * down, p_C.norm()};
    if (shape.wraps && place.u >= shape.columns - 0.5) place.u -= shape.columns;
    if (shape.wraps && place.u < -0.5) place.u += shape.columns;
  }
  const bool inside =
      place.u >= -0.5 && place.u <= shape.columns - 0.5 && place.v >= -0.5 && place.v <= shape.rows - 0.5;
  if (!inside) return std::nullopt;
  return place;
}

RayGrid::RayGrid(const DepthSensor& sensor) : sensor_(checked(sensor)), rays_(sensor.shape.pixels(), 3) {
  for (int v = 0, pixel = 0; v < shape().rows; ++v) {
    for (int u = 0; u < shape().columns; ++u, ++pixel) {
      rays_.row(pixel) = shape().ray(u, v).cast<float>().transpose().array();
    }
  }
}

DepthPicture::DepthPicture(std::shared_ptr<const RayGrid> grid) : grid_(std::move(grid)) { move_to({}); }

void DepthPicture::move_to(const SensorPose& pose) {
  set_pose(pose);
  depths_.setConstant(shape().pixels(), range());
}

void DepthPicture::set_pose(const SensorPose& pose) {
  pose_ = pose;
  const Eigen::Matrix3f R_WC = pose.q_WC.toRotationMatrix().cast<float>();
  rays_W_.resize(shape().pixels(), 3);
  const Eigen::ArrayX3f& rays = grid_->rays();
  for (int a = 0; a < 3; ++a) {
    rays_W_.col(a) = rays.col(0) * R_WC(a, 0) + rays.col(1) * R_WC(a, 1) + rays.col(2) * R_WC(a, 2);
  }
}

std::optional<PicturePoint> DepthPicture::place_of(const Vec3& p_W) const {
  return place_in(shape(), pose_.q_WC.conjugate() * (p_W - pose_.position));
}

}  // namespace tern
