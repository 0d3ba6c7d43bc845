// Whether a box is out of a sensor's range.
#pragma once

#include "core/base/types.h"

namespace tern {

/// A track counts as out of range if its box is farther from the sensor than the range less this margin, m. It allows
/// for some σ and for the vehicle's motion during a frame.
inline constexpr double kRangeMargin = 0.5;

/// @param range_m  0: unlimited; @param from  the sensor, W, m
inline bool is_beyond_range(double range_m, const Vec3& from, const Vec3& centre, const Vec3& half) {
  return range_m > 0.0 && ((centre - from).cwiseAbs() - half).cwiseMax(0.0).norm() > range_m - kRangeMargin;
}

}  // namespace tern
