#include "simulator/vehicle/attitude.h"

#include <cmath>

#include "core/world/vehicle.h"

namespace tern {
namespace {

/// Shorter thrusts, m/s², and smaller sines of angles have no direction.
constexpr double kNoDirection = 1e-6;

}  // namespace

Eigen::Quaterniond attitude_of(const Vec3& acceleration, double yaw) {
  const Vec3 thrust = acceleration + Vec3(0.0, 0.0, kGravity);
  const Vec3 heading(std::cos(yaw), std::sin(yaw), 0.0);
  const Vec3 left = thrust.cross(heading);
  if (left.norm() <= kNoDirection * (1.0 + thrust.norm())) {
    return Eigen::Quaterniond(Eigen::AngleAxisd(yaw, Vec3::UnitZ()));
  }
  Eigen::Matrix3d R_WB;
  R_WB.col(2) = thrust.normalized();
  R_WB.col(1) = left.normalized();
  R_WB.col(0) = R_WB.col(1).cross(R_WB.col(2));
  return Eigen::Quaterniond(R_WB);
}

}  // namespace tern
