// What sensors say of obstacles, and what really moved.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/types.h"
#include "core/world/header.h"

namespace tern {

inline constexpr std::int64_t kNoTrackId = -1;

/// One detection of an obstacle's box.
struct Detection {
  Vec3 position = Vec3::Zero();        ///< centre in W, m
  Vec3 half_extents = Vec3::Zero();    ///< m, ≥ 0
  Vec3 variance = Vec3::Zero();        ///< of the position per axis, m², ≥ 0
  std::int64_t track_id = kNoTrackId;  ///< ≥ 0 if the sensor tracks, else kNoTrackId
};

/// OBSTACLE_OBSERVATIONS: the detections of one sensor at one instant.
struct ObservationSet {
  Header header;
  UTime at;  ///< when the world was so (before latency), vehicle's clock
  std::int32_t sensor_id = 0;
  double range_m = 0.0;                 ///< how far the sensor sees, m; 0: without limit
  Vec3 sensor_position = Vec3::Zero();  ///< in W, m
  std::vector<Detection> detections;
};

/// OBSTACLE_TRUTH: one obstacle as it really is.
struct TrueObstacle {
  std::int64_t id = 0;
  Vec3 position = Vec3::Zero();      ///< W, m
  Vec3 velocity = Vec3::Zero();      ///< m/s
  Vec3 half_extents = Vec3::Zero();  ///< m
  bool moves = false;
};

struct ObstacleTruth {
  Header header;
  BatchHeader batch;
  UTime at;
  std::vector<TrueObstacle> obstacles;
  std::int32_t left_out = 0;  ///< obstacles that did not fit in the batches
};

}  // namespace tern
