// Simulated cameras and lidars: depth pictures of the true world, and the sightings in them.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "core/base/time.h"
#include "core/world/sighting.h"
#include "perception/depth_picture.h"
#include "perception/detector.h"
#include "perception/rasterizer.h"

namespace tern {

/// A camera or lidar and its mount on the vehicle.
struct DepthSensorConfig {
  DepthSensor optics;
  double rate_hz = 30.0;         ///< frames per second, > 0
  double latency_s = 0.05;       ///< delay of a frame after its time, ≥ 0
  bool on_gimbal = true;         ///< level, and turned with the vehicle's heading; false: fixed to the body
  Vec3 position = Vec3::Zero();  ///< from the vehicle's position, forward, left, up, m
  double yaw = 0.0;              ///< to the left from forward, rad
  double pitch = 0.0;            ///< upwards, rad
};

/// The camera of Tern's benchmarks: 85.2° × 58° in 106 × 72 pixels, 0.2–10 m, σ 0.0025 z², 30 Hz, 50 ms.
DepthSensorConfig default_camera();
/// Its lidar: a ray per degree from −7° to 52°, all around, 0.2–20 m, σ 0.02 m, 10 Hz, 100 ms.
DepthSensorConfig default_lidar();

/// Returns the pose of a sensor on a vehicle at p_WB with the attitude q_WB.
SensorPose mounted(const DepthSensorConfig& config, const Vec3& p_WB, const Eigen::Quaterniond& q_WB);

/// The surfaces of the world at one time.
struct TrueSurfaces {
  std::span<const Box> obstacles{};  ///< W
  std::span<const Box> map{};        ///< occupied voxels, W. The detector knows them.
  std::optional<double> ground_z{};  ///< W, m. The detector knows it.
};

/// Renders frames and detects in them. Its memory is kept from frame to frame. A frame is a function of its arguments
/// and the seed.
class SimulatedDepthSensor {
 public:
  /// @throws std::invalid_argument for optics out of range
  SimulatedDepthSensor(const DepthSensorConfig& config, std::int32_t sensor_id, std::uint64_t seed);

  /// Returns frame number `frame`, as measured from `pose` at the time `at`. The header is empty.
  /// @param believed  the pose that the vehicle believes its sensor to have; sightings and view are relative to it
  SightingSet look(const TrueSurfaces& surfaces, const SensorPose& pose, const SensorPose& believed, UTime at,
                   std::int64_t frame);

  [[nodiscard]] const DepthSensorConfig& config() const { return config_; }
  /// The picture of the newest frame.
  [[nodiscard]] const DepthPicture& picture() const { return picture_; }

 private:
  DepthSensorConfig config_;
  std::int32_t sensor_id_;
  std::uint64_t seed_;
  DepthPicture picture_;
  Rasterizer rasterizer_;
  Detector detector_;
};

}  // namespace tern
