// Errors that all sightings of one frame share: those of the sensor's pose and clock.
#pragma once

#include <numbers>

#include "core/base/types.h"

namespace tern {

/// Standard deviations of a sensor's attitude, rad, and of its clock, s.
struct FrameError {
  double attitude = 0.0, clock = 0.0;
};
/// The part that differs from frame to frame. Filters average it, so it is part of a measurement's variance.
inline constexpr FrameError kFrameJitter{0.3 * std::numbers::pi / 180.0, 0.003};
/// All of it, with the part that stays for seconds: mounting, calibration, delay. A place in one frame and the same
/// place in another frame, taken from elsewhere, differ by it.
inline constexpr FrameError kFrameOffset{1.0 * std::numbers::pi / 180.0, 0.01};

/// Returns the variance that the frame's errors add to a place, m²: (σ_attitude distance)² + (σ_clock speed)². It is
/// given to all axes alike.
/// @param from_sensor  the place as seen from the sensor, m; @param velocity  relative to the sensor, m/s
inline double frame_variance(const FrameError& error, const Vec3& from_sensor, const Vec3& velocity) {
  return error.attitude * error.attitude * from_sensor.squaredNorm() +
         error.clock * error.clock * velocity.squaredNorm();
}

}  // namespace tern
