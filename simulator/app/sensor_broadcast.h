// Publishes the frames of the sensors of `simulator.sensors`.
#pragma once

#include <cstdint>
#include <deque>
#include <utility>
#include <variant>
#include <vector>

#include "runtime/bus.h"
#include "simulator/app/simulator_config.h"
#include "simulator/sensors/depth_sensor.h"
#include "simulator/vehicle/vehicle.h"
#include "simulator/worlds/world.h"

namespace tern {

/// Publishes OBSTACLE_SIGHTINGS of cameras and lidars, and OBSTACLE_OBSERVATIONS of the sensors `near` and `truth`.
/// Each sensor has its own rate and latency; its id is its place in the list.
///
/// Frames are numbered from the start of the process. As soon as world zero is known, they are numbered from there, and
/// earlier frames have negative numbers.
class SensorBroadcast {
 public:
  SensorBroadcast(Bus& bus, const SimulatorConfig& config, UTime now);

  void start(UTime world_zero, UTime now);
  /// The occupied voxels of the map, as boxes (W): they are seen, and known.
  void set_map(std::vector<Box> boxes) { map_ = std::move(boxes); }
  [[nodiscard]] UTime next_wakeup() const;
  /// Publishes all frames that are due. A frame is rendered from the vehicle's true pose at the frame's time. It is
  /// published relative to the believed pose (Navigation), since the vehicle knows no other.
  /// @param world_at  returns the world that exists at a time (WorldBroadcast::world_at)
  template <class WorldAt>
  void step(UTime now, Vehicle& vehicle, WorldAt&& world_at) {
    remember(vehicle);
    for (Mounted& sensor : sensors_) {
      for (; arrives(sensor) <= now; ++sensor.frame) publish(sensor, vehicle, world_at(taken(sensor)));
    }
  }

 private:
  struct Mounted {
    std::variant<SensorConfig, SimulatedDepthSensor> model;
    double rate_hz, latency_s;
    std::int64_t frame = 0;
  };
  [[nodiscard]] UTime taken(const Mounted& sensor) const;
  [[nodiscard]] UTime arrives(const Mounted& sensor) const;
  void remember(const Vehicle& vehicle);
  [[nodiscard]] Eigen::Quaterniond attitude_at(UTime t) const;
  void publish(Mounted& sensor, Vehicle& vehicle, const World& world);

  Bus& bus_;
  std::optional<double> ground_z_;
  UTime frames_zero_;
  std::vector<Mounted> sensors_;
  std::vector<Box> map_, boxes_;
  std::deque<std::pair<UTime, Eigen::Quaterniond>> attitudes_;  ///< ascending
};

}  // namespace tern
