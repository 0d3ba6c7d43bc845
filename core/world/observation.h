// The messages OBSTACLE_OBSERVATIONS and OBSTACLE_TRUTH: obstacles as sensors measure them, and as they really are.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/types.h"
#include "core/wire/header.h"

namespace tern {

/// The track id of a detection whose sensor does not track.
inline constexpr std::int64_t kNoTrackId = -1;

/// One box that a sensor measured at one time.
struct Detection {
  Vec3 position = Vec3::Zero();        ///< centre, W, m
  Vec3 half_extents = Vec3::Zero();    ///< m, ≥ 0
  Vec3 variance = Vec3::Zero();        ///< of the position, per axis, m², ≥ 0
  std::int64_t track_id = kNoTrackId;  ///< ≥ 0 if the sensor tracks, else kNoTrackId
};

/// OBSTACLE_OBSERVATIONS: one frame, the detections of one sensor at one time.
struct ObservationSet {
  Header header;
  UTime at;  ///< when the sensor measured, latency not included, vehicle's clock
  std::int32_t sensor_id = 0;
  double range_m = 0.0;                 ///< range of the sensor, m; 0: unlimited
  Vec3 sensor_position = Vec3::Zero();  ///< W, m
  std::vector<Detection> detections;
};

/// One obstacle as it really is.
struct TrueObstacle {
  std::int64_t id = 0;
  Vec3 position = Vec3::Zero();      ///< W, m
  Vec3 velocity = Vec3::Zero();      ///< m/s
  Vec3 half_extents = Vec3::Zero();  ///< m
  bool moves = false;
};

/// OBSTACLE_TRUTH: the obstacles as they really are, or a batch of them.
struct ObstacleTruth {
  Header header;
  BatchHeader batch;
  UTime at;
  std::vector<TrueObstacle> obstacles;
  std::int32_t left_out = 0;  ///< obstacles that did not fit into the batches
};

}  // namespace tern
