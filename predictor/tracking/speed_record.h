// The speeds of a scene's tracks. They choose the prior of the calibration and bound the reach of an obstacle.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>

#include "core/base/time.h"
#include "core/base/types.h"
#include "predictor/tracking/calibration_prior.h"

namespace tern {

/// A track's speed is its distance over this span, s; one of kEvaluatedAhead. Over this span, noise and a single
/// exchanged detection change the speed little.
inline constexpr double kSpeedSpan = 0.5;
/// A scene is slow once this many tracks were seen to move, all slower than kSlowSpeed. By the rule of succession the
/// next one is faster once in 18 times. After the first faster track, the scene is not slow for the rest of the flight.
inline constexpr std::size_t kMinMovers = 16;
/// A slower track does not count as moving, m/s.
inline constexpr double kMinMovingSpeed = 0.5;

/// A track's mean velocity over kSpeedSpan.
struct TrackSpeed {
  UTime from;     ///< start of the span
  Vec3 velocity;  ///< W, m/s
};

/// The record of all tracks of a flight.
class SpeedRecord {
 public:
  /// Takes the velocity of a track by sightings. Such a track may jump to a neighbour. So a speed counts once the track
  /// has kept it on the same axis over two spans that do not overlap.
  /// @param last  the track's span before, or nullopt; replaced unless the two overlap
  void add_sighted(const TrackSpeed& speed, std::int64_t track, std::optional<TrackSpeed>& last) {
    if (last && (speed.from - last->from).seconds() < kSpeedSpan) return;
    if (last) add(speed.velocity.cwiseAbs().cwiseMin(last->velocity.cwiseAbs()), track);
    last = speed;
  }
  /// @param velocity  mean velocity of a track over kSpeedSpan, W, m/s
  void add(const Vec3& velocity, std::int64_t track) {
    max_axis_speed_ = std::max(max_axis_speed_, velocity.cwiseAbs().maxCoeff());
    max_speed_ = std::max(max_speed_, velocity.norm());
    if (velocity.norm() > kMinMovingSpeed && movers_.size() < kMinMovers) movers_.insert(track);
  }
  /// The largest speed per axis that any track had, m/s.
  [[nodiscard]] double max_axis_speed() const { return max_axis_speed_; }
  [[nodiscard]] SceneSpeed scene_speed() const {
    return movers_.size() >= kMinMovers && max_speed_ < kSlowSpeed ? SceneSpeed::Slow : SceneSpeed::Any;
  }

 private:
  double max_axis_speed_ = 0.0, max_speed_ = 0.0;
  std::set<std::int64_t> movers_;  // at most kMinMovers
};

}  // namespace tern
