// The slope of a quantity over the last readings.
#pragma once

#include <deque>

#include "core/base/types.h"
#include "ros_bridge/intake.h"

namespace tern::ros {

/// A line needs this many readings to tell slope from noise.
inline constexpr std::size_t kFewestForSlope = 3;

/// Returns the least-squares slope of a member (position or velocity) over time, per second; 0 for less than
/// kFewestForSlope readings.
/// @pre the times of the readings differ
inline Vec3 slope_of(const std::deque<OdometryReading>& readings, Vec3 OdometryReading::*member) {
  if (readings.size() < kFewestForSlope) return Vec3::Zero();
  const auto n = static_cast<double>(readings.size());
  const auto seconds = [&](const OdometryReading& r) { return (r.at - readings.back().at).seconds(); };
  double mean_t = 0.0, squares = 0.0;
  Vec3 mean = Vec3::Zero(), products = Vec3::Zero();
  for (const OdometryReading& r : readings) {
    mean_t += seconds(r) / n;
    mean += r.*member / n;
  }
  for (const OdometryReading& r : readings) {
    const double t = seconds(r) - mean_t;
    squares += t * t;
    products += t * (r.*member - mean);
  }
  return products / squares;
}

}  // namespace tern::ros
