// Sightings of true boxes, by the rendering and the detector that the simulator's cameras use.
#pragma once

#include <memory>
#include <numbers>
#include <vector>

#include "core/base/time.h"
#include "core/world/sighting.h"
#include "perception/detector.h"
#include "perception/rasterizer.h"

namespace tern::testing {

/// A camera of 85.2° × 58°, 0.2 to 10 m, or a lidar of 360° × (−7° … 52°), 20 m.
class RenderingSensor {
 public:
  static RenderingSensor camera(std::int32_t id = 0) {
    DepthSensor sensor;
    sensor.shape = camera_shape(radians(85.2), radians(58.0), 106, 72);
    sensor.noise = {0.003, 0.0025, 1};
    return {sensor, id};
  }
  static RenderingSensor lidar(std::int32_t id = 1) {
    DepthSensor sensor;
    sensor.shape = lidar_shape(2.0 * std::numbers::pi, radians(-7.0), radians(52.0), 360, 60);
    sensor.range_m = 20.0;
    sensor.noise = {0.02, 0.0, 1};
    return {sensor, id};
  }
  /// The frame at time t of the boxes, by a sensor at `eye` that looks along yaw (rad).
  SightingSet frame(UTime t, const Vec3& eye, double yaw, const std::vector<Box>& boxes) {
    raster_.begin(picture_, looking(eye, yaw));
    for (const Box& box : boxes) raster_.add(picture_, box);
    raster_.end(picture_);
    add_noise(picture_, 1, id_, frames_++);
    return frame_of(picture_, detector_->detect(picture_, {}), t, id_);
  }

 private:
  static double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }
  RenderingSensor(const DepthSensor& sensor, std::int32_t id)
      : picture_(std::make_shared<const RayGrid>(sensor)), id_(id) {}

  DepthPicture picture_;
  Rasterizer raster_;
  std::unique_ptr<Detector> detector_ = std::make_unique<Detector>();
  std::int32_t id_;
  std::int64_t frames_ = 0;
};

}  // namespace tern::testing
