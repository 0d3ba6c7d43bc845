// Rendered scenes of boxes, and the sensors of the tests.
#pragma once

#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "core/world/scan.h"
#include "core/world/sighting.h"
#include "perception/depth_picture.h"
#include "perception/rasterizer.h"

namespace tern::support {

inline constexpr double kDegree = std::numbers::pi / 180.0;

inline DepthSensor camera(int block = 1) {
  DepthSensor sensor;
  sensor.shape = camera_shape(85.2 * kDegree, 58.0 * kDegree, 106, 72);
  sensor.noise = {0.0, 0.0025, block};
  return sensor;
}

inline DepthSensor lidar() {
  DepthSensor sensor;
  sensor.shape = lidar_shape(360.0 * kDegree, -7.5 * kDegree, 52.5 * kDegree, 360, 60);
  sensor.range_m = 20.0;
  sensor.noise = {0.02, 0.0, 1};
  return sensor;
}

/// A picture with noise, the same without, and for each pixel the box that it shows (−1: none).
struct Scene {
  DepthPicture picture, truth;
  std::vector<Box> boxes;
  std::vector<int> shown;

  explicit Scene(const DepthSensor& sensor)
      : picture(std::make_shared<RayGrid>(sensor)), truth(std::make_shared<RayGrid>(sensor)) {}

  void render(const SensorPose& pose, std::vector<Box> of, std::optional<double> ground_z = {}, int frame = 0) {
    boxes = std::move(of);
    shown.assign(idx(picture.shape().pixels()), -1);
    Rasterizer rasterizer;
    rasterizer.begin(truth, pose);
    if (ground_z) rasterizer.add_ground(truth, *ground_z);
    for (std::size_t k = 0; k < boxes.size(); ++k) {
      const Eigen::ArrayXf before = truth.depths();
      rasterizer.add(truth, boxes[k]);
      for (int pixel = 0; pixel < truth.shape().pixels(); ++pixel) {
        if (truth.depths()[pixel] < before[pixel]) shown[idx(pixel)] = static_cast<int>(k);
      }
    }
    rasterizer.end(truth);
    picture.move_to(pose);
    picture.depths() = truth.depths();
    add_noise(picture, 1, 0, frame);
  }

  /// The true point of a pixel, W.
  [[nodiscard]] Vec3 point(int pixel) const {
    return truth.pose().position + truth.at_depth(pixel, truth.depths()[pixel]).cast<double>();
  }

  /// How many pixels of each box lie within 0.1 m of a sighting.
  [[nodiscard]] std::map<int, int> owners(const Sighting& sighting) const {
    const Box box = grown(Box(sighting.lower, sighting.upper), Vec3::Constant(0.1));
    std::map<int, int> of;
    for (int pixel = 0; pixel < truth.shape().pixels(); ++pixel) {
      if (truth.is_surface(pixel) && shown[idx(pixel)] >= 0 && box.contains(point(pixel))) ++of[shown[idx(pixel)]];
    }
    return of;
  }
};

/// The picture of a pinhole camera as DEPTH_IMAGEs in millimetres: the first `rows` rows, and the others.
inline std::vector<DepthImage> depth_images(const DepthPicture& picture, int rows) {
  const DepthSensor& sensor = picture.sensor();
  const SensorPose& pose = picture.pose();
  DepthImage first;
  first.range_m = sensor.range_m;
  first.sensor_position = pose.position;
  first.q_WC = {pose.q_WC.w(), pose.q_WC.x(), pose.q_WC.y(), pose.q_WC.z()};
  first.fx = sensor.shape.fx;
  first.fy = sensor.shape.fy;
  first.cx = sensor.shape.cx;
  first.cy = sensor.shape.cy;
  first.width = sensor.shape.columns;
  DepthImage second = first;
  second.first_row = rows;
  for (int pixel = 0; pixel < sensor.shape.pixels(); ++pixel) {
    const auto depth = static_cast<std::int16_t>(picture.depths()[pixel] * 1000.0F);
    (pixel < rows * first.width ? first : second).depths.push_back(depth);
  }
  return {first, second};
}

}  // namespace tern::support
