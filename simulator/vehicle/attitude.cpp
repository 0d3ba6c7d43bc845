#include "simulator/vehicle/attitude.h"

#include <cmath>

#include "core/world/vehicle.h"

namespace tern {
namespace {

/// A multirotor that flies upright has at least this thrust upwards, m/s².
constexpr double kLeastThrust = 1e-6;

}  // namespace

Eigen::Quaterniond attitude_of(const Vec3& acceleration, double yaw) {
  const Vec3 thrust = acceleration + Vec3(0.0, 0.0, kGravity);
  if (thrust.z() < kLeastThrust) return Eigen::Quaterniond(Eigen::AngleAxisd(yaw, Vec3::UnitZ()));
  const Vec3 left(-std::sin(yaw), std::cos(yaw), 0.0);
  Eigen::Matrix3d R_WB;
  R_WB.col(2) = thrust.normalized();
  R_WB.col(0) = left.cross(thrust).normalized();
  R_WB.col(1) = R_WB.col(2).cross(R_WB.col(0));
  return Eigen::Quaterniond(R_WB);
}

}  // namespace tern
