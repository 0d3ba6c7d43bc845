// Conversions between Tern's frames (east-north-up, forward-left-up) and MAVLink's (north-east-down,
// forward-right-down).
#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "core/base/types.h"

namespace tern::mavlink {

/// Converts a world vector in either direction: (x, y, z) ↦ (y, x, −z).
inline Vec3 swapped(const Vec3& x) { return {x.y(), x.x(), -x.z()}; }
inline Vec3 enu_of(const std::array<float, 3>& ned) { return swapped(Vec3(ned[0], ned[1], ned[2])); }
inline std::array<float, 3> ned_of(const Vec3& enu) {
  return {static_cast<float>(enu.y()), static_cast<float>(enu.x()), static_cast<float>(-enu.z())};
}

/// Wraps an angle to (−π, π].
inline double wrapped(double angle) {
  const double turned = std::remainder(angle, 2.0 * std::numbers::pi);
  return turned <= -std::numbers::pi ? std::numbers::pi : turned;
}
/// Converts a heading in either direction: clockwise from north, anticlockwise from east; rad.
inline double swapped_yaw(double yaw) { return wrapped(std::numbers::pi / 2.0 - yaw); }

/// Converts an attitude in either direction, body axes included: FLU to ENU, FRD to NED.
inline Eigen::Quaterniond swapped(const Eigen::Quaterniond& q) {
  // World: half a turn about (1, 1, 0); body: half a turn about x.
  const double h = std::numbers::sqrt2 / 2.0;
  return Eigen::Quaterniond(0.0, h, h, 0.0) * q * Eigen::Quaterniond(0.0, 1.0, 0.0, 0.0);
}
inline Eigen::Quaterniond quaternion_of(const std::array<float, 4>& wxyz) {
  return Eigen::Quaterniond(wxyz[0], wxyz[1], wxyz[2], wxyz[3]);
}
inline std::array<float, 4> wxyz_of(const Eigen::Quaterniond& q) {
  return {static_cast<float>(q.w()), static_cast<float>(q.x()), static_cast<float>(q.y()), static_cast<float>(q.z())};
}
/// The heading of the body's x axis in ENU, rad.
inline double yaw_of(const Eigen::Quaterniond& flu_to_enu) {
  const Vec3 x = flu_to_enu * Vec3::UnitX();
  return std::atan2(x.y(), x.x());
}

}  // namespace tern::mavlink
