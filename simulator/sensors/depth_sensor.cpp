#include "simulator/sensors/depth_sensor.h"

#include <cmath>
#include <numbers>

namespace tern {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

Eigen::Quaterniond heading_of(const Eigen::Quaterniond& q_WB) {
  const Vec3 ahead = q_WB * Vec3::UnitX();
  return Eigen::Quaterniond(Eigen::AngleAxisd(std::atan2(ahead.y(), ahead.x()), Vec3::UnitZ()));
}

}  // namespace

DepthSensorConfig default_camera() {
  DepthSensorConfig config;
  config.optics.shape = camera_shape(85.2 * kDegree, 58.0 * kDegree, 106, 72);
  config.optics.noise.per_m = 0.0025;
  return config;
}

DepthSensorConfig default_lidar() {
  DepthSensorConfig config;
  config.optics.shape = lidar_shape(2.0 * std::numbers::pi, -7.5 * kDegree, 52.5 * kDegree, 360, 60);
  config.optics.range_m = 20.0;
  config.optics.noise.constant_m = 0.02;
  config.rate_hz = 10.0;
  config.latency_s = 0.1;
  return config;
}

SensorPose mounted(const DepthSensorConfig& config, const Vec3& p_WB, const Eigen::Quaterniond& q_WB) {
  const Eigen::Quaterniond q = config.on_gimbal ? heading_of(q_WB) : q_WB;
  const SensorPose on_vehicle = looking(config.position, config.yaw, config.pitch);
  return {p_WB + q * on_vehicle.position, q * on_vehicle.q_WC};
}

SimulatedDepthSensor::SimulatedDepthSensor(const DepthSensorConfig& config, std::int32_t sensor_id, std::uint64_t seed)
    : config_(config), sensor_id_(sensor_id), seed_(seed), picture_(std::make_shared<RayGrid>(config.optics)) {}

SightingSet SimulatedDepthSensor::look(const TrueSurfaces& surfaces, const SensorPose& pose, const SensorPose& believed,
                                       UTime at, std::int64_t frame) {
  rasterizer_.begin(picture_, pose);
  for (const Box& box : surfaces.obstacles) rasterizer_.add(picture_, box);
  for (const Box& box : surfaces.map) rasterizer_.add(picture_, box);
  if (surfaces.ground_z) rasterizer_.add_ground(picture_, *surfaces.ground_z);
  rasterizer_.end(picture_);
  add_noise(picture_, seed_, sensor_id_, frame);
  picture_.set_pose(believed);
  return frame_of(picture_, detector_.detect(picture_, {surfaces.ground_z, surfaces.map}), at, sensor_id_);
}

}  // namespace tern
