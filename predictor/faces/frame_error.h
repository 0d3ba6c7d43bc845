// Errors that all sightings of one frame share: those of the sensor's pose and clock.
#pragma once

#include <numbers>

#include "core/base/types.h"

namespace tern {

/// Standard deviations of a sensor's attitude, rad, and of its clock, s.
inline constexpr double kAttitudeSigma = std::numbers::pi / 180.0, kClockSigma = 0.01;

/// Returns the variance that the frame's errors add to a place, m²: (σ_attitude distance)² + (σ_clock speed)². It is
/// given to all axes alike.
/// @param from_sensor  the place as seen from the sensor, m; @param velocity  relative to the sensor, m/s
inline double frame_variance(const Vec3& from_sensor, const Vec3& velocity) {
  return kAttitudeSigma * kAttitudeSigma * from_sensor.squaredNorm() +
         kClockSigma * kClockSigma * velocity.squaredNorm();
}

}  // namespace tern
