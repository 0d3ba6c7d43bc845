// The part of the horizontal plane at a sensor's height that the sensor saw to be empty.
#pragma once

#include <vector>

#include "core/base/types.h"
#include "core/world/sighting.h"

namespace tern {

/// The free depth by direction: the k-th of equal sectors was seen to be empty from the sensor to reach[k].
struct SightFan {
  Eigen::Vector2d eye = Eigen::Vector2d::Zero();  ///< position of the sensor, W, m
  double first = 0.0;                             ///< azimuth of the first sector's start, about W's z from W's x, rad
  double width = 0.0;                             ///< of a sector, rad, > 0
  double nearest = 0.0;                           ///< nothing is known below this distance, m
  double age_s = 0.0;                             ///< it was seen this long before the field's time, s, ≥ 0
  std::vector<double> reach;                      ///< per sector, anticlockwise, m; 0: nothing is known

  /// True if the disc lies in the fan, beyond `nearest` and within the reach of every sector that it touches.
  [[nodiscard]] bool sees_empty(const Eigen::Vector2d& centre, double radius) const;
};

/// Returns the fan of a view whose rows are level within kLevel; otherwise, and for a view without cells, a fan without
/// sectors. A cell's depth is reduced by its 3σ. The row used is the one that contains the horizontal plane.
///
/// A pinhole's columns are equal in tan(azimuth). A sector takes the smallest range of the columns that it touches, so
/// the fan is never deeper than the picture.
SightFan level_fan(const SensorView& view);

/// Sectors of a fan per column of its picture.
inline constexpr int kSectorsPerColumn = 2;
/// A view is level if its axis y differs from the vertical by at most this, rad.
inline constexpr double kLevel = 0.02;

}  // namespace tern
