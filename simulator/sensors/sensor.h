// What a sensor on the vehicle sees of the true world: OBSTACLE_OBSERVATIONS.
#pragma once

#include <cstdint>

#include "core/base/time.h"
#include "core/world/observation.h"
#include "simulator/worlds/world.h"

namespace tern {

/// A sensor. The default tells the truth at once.
struct SensorConfig {
  bool present = true;  ///< false: there is no sensor, nothing is published
  std::int32_t sensor_id = 0;
  double rate_hz = 30.0;        ///< frames per second, > 0
  double range_m = 0.0;         ///< sees boxes whose nearest point is this near, ≥ 0; 0: without limit
  Vec3 sigma_m = Vec3::Zero();  ///< standard deviation of the position per axis, m, ≥ 0
  double latency_s = 0.0;       ///< a frame arrives this much after the world was so, ≥ 0
  double dropout = 0.0;         ///< probability that a detection is missing, in [0, 1]
  bool track_ids = true;        ///< says which obstacle it is; if not, detections come in an order that tells nothing
  int max_detections = 600;     ///< beyond this the farthest are left out, ≥ 0: a message stays under 60 kB
  std::uint64_t seed = 1;
};

/// BENCHMARKS' perception-only sensor: 8 m all around, σ 0.05 m, 30 Hz, 50 ms late, 5 % dropped, no ids.
SensorConfig perception_only(std::uint64_t seed);

/// When frame k is taken: world_zero + k / rate_hz, and when it arrives. Those before world zero have k < 0.
UTime frame_taken(const SensorConfig& config, UTime world_zero, std::int64_t frame);
UTime frame_arrives(const SensorConfig& config, UTime world_zero, std::int64_t frame);

/// Frame k: the obstacles present at that instant, seen from sensor_position (W). There is no occlusion. Noise and
/// dropout come from (seed, k) alone, so that frames may be asked for in any order. Detections are by id ascending when
/// the sensor knows ids, else by position (x, then y, then z, as measured). variance = sigma². The header is empty.
/// @throws std::invalid_argument when the configuration is out of range.
ObservationSet observe(const World& world, const SensorConfig& config, UTime world_zero, std::int64_t frame,
                       const Vec3& sensor_position);

}  // namespace tern
