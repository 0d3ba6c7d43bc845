// The simulated sensor: OBSTACLE_OBSERVATIONS from the true world.
#pragma once

#include <cstdint>

#include "core/base/time.h"
#include "core/world/observation.h"
#include "simulator/worlds/world.h"

namespace tern {

/// A sensor. The default reports the truth without delay.
struct SensorConfig {
  bool present = true;  ///< false: there is no sensor, and no messages
  std::int32_t sensor_id = 0;
  double rate_hz = 30.0;        ///< frames per second, > 0
  double range_m = 0.0;         ///< it detects boxes whose nearest point is within this, ≥ 0; 0: without limit
  Vec3 sigma_m = Vec3::Zero();  ///< standard deviation of the position per axis, m, ≥ 0
  double latency_s = 0.0;       ///< delay of a frame after its time, ≥ 0
  double dropout = 0.0;         ///< probability that a detection is missing, [0, 1]
  bool track_ids = true;        ///< detections have obstacle ids; without them their order contains no identity
  int max_detections = 600;     ///< the farthest beyond this number are left out, ≥ 0: a message stays under 60 kB
  std::uint64_t seed = 1;
};

/// The sensor of perception-only worlds: 8 m all around, σ 0.05 m, 30 Hz, 50 ms latency, 5 % dropout, no ids.
SensorConfig perception_only(std::uint64_t seed);

/// Time of frame k, world_zero + k / rate_hz, and its arrival. Frames before world zero have k < 0.
UTime frame_taken(const SensorConfig& config, UTime world_zero, std::int64_t frame);
UTime frame_arrives(const SensorConfig& config, UTime world_zero, std::int64_t frame);

/// Returns frame k: the detections of the obstacles that are present at its time, from sensor_position (W).
///
/// There is no occlusion. Noise and dropout depend on (seed, k) only, so frames may be requested in any order.
/// Detections are sorted by id, or without ids by measured position (x, y, z). variance = sigma². The header is empty.
/// @throws std::invalid_argument if the configuration is out of range.
ObservationSet observe(const World& world, const SensorConfig& config, UTime world_zero, std::int64_t frame,
                       const Vec3& sensor_position);

}  // namespace tern
