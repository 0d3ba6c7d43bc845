// Whether a depth sensor is frozen: its driver repeats one measurement while the sensor moves.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "core/world/scan.h"

namespace tern {

/// The depths of one measurement, in the order in which they were sent, and the sensor's pose. A cloud's depths are its
/// distances: they stay the same if the driver turns a repeated cloud with the vehicle.
struct MeasuredDepths {
  static constexpr std::size_t kMost = 2'097'152;  ///< of a larger measurement, the first ones are compared

  Vec3 position = Vec3::Zero();      ///< W, m
  Eigen::Vector4d q_WC{1, 0, 0, 0};  ///< w, x, y, z; of a cloud the identity, since it states no attitude
  std::vector<float> depths;         ///< m; 0: not measured
  std::size_t surfaces = 0;          ///< depths within the range; the others say `nothing`, or are not measured

  /// Adds the depths of a message. A depth of 32767 units, or from the range on, is no surface.
  void add(const DepthImage& part);
  /// The same. Without a range, a point from 500 m on is no surface.
  void add(const CloudScan& part);
};

/// Remembers the newest depths of each sensor that differ from those before, and the sensor's pose then.
///
/// | measurement                                         | frozen                                 |
/// |-----------------------------------------------------|----------------------------------------|
/// | differs from the one remembered                     | no: a sensor's noise changes every one |
/// | the same, from the same place                       | no: a sensor without noise, at rest    |
/// | the same, kMoved or kTurned away                    | yes                                    |
/// | has fewer than kLeastSurfaces, as of an empty field | no: it looks the same from everywhere  |
///
/// A sensor without noise that flies level over a plane looks frozen as well.
class FrozenCheck {
 public:
  static constexpr double kMoved = 0.2;    ///< m
  static constexpr double kTurned = 0.05;  ///< rad
  static constexpr std::size_t kLeastSurfaces = 16;
  /// Of more sensors, the one whose measurement is oldest is forgotten.
  static constexpr std::size_t kMostSensors = 32;

  /// O(depths).
  [[nodiscard]] bool is_frozen(std::int32_t sensor, MeasuredDepths now);

 private:
  struct Seen {
    MeasuredDepths measured;
    std::int64_t number = 0;  // of the newest measurement
  };
  std::map<std::int32_t, Seen> seen_;
  std::int64_t number_ = 0;
};

}  // namespace tern
