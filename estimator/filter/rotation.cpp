#include "estimator/filter/rotation.h"

#include <cmath>

namespace tern {
namespace {

/// Below this angle (rad) the closed forms lose digits to cancellation, and two terms of the series are exact.
constexpr double kSmallAngle = 1e-2;

}  // namespace

RotationIntegrals rotation_integrals(const Vec3& phi) {
  const double angle2 = phi.squaredNorm();
  const double angle = std::sqrt(angle2);
  // Exp = 1 + s₁S + s₂S², Γ₁ = 1 + s₂S + s₃S², Γ₂ = 1/2 + s₃S + s₄S²
  double s1, s2, s3, s4;
  if (angle < kSmallAngle) {
    s1 = 1.0 - angle2 / 6.0 * (1.0 - angle2 / 20.0);
    s2 = 0.5 - angle2 / 24.0 * (1.0 - angle2 / 30.0);
    s3 = 1.0 / 6.0 - angle2 / 120.0 * (1.0 - angle2 / 42.0);
    s4 = 1.0 / 24.0 - angle2 / 720.0 * (1.0 - angle2 / 56.0);
  } else {
    s1 = std::sin(angle) / angle;
    s2 = (1.0 - std::cos(angle)) / angle2;
    s3 = (1.0 - s1) / angle2;
    s4 = (0.5 - s2) / angle2;
  }
  const Eigen::Matrix3d S = skew(phi), S2 = S * S, one = Eigen::Matrix3d::Identity();
  return {one + s1 * S + s2 * S2, one + s2 * S + s3 * S2, 0.5 * one + s3 * S + s4 * S2};
}

Eigen::Matrix3d exp_rotation(const Vec3& phi) { return rotation_integrals(phi).exp; }

Vec3 log_rotation(const Eigen::Matrix3d& R) {
  const Eigen::AngleAxisd turn(Eigen::Quaterniond(R).normalized());
  return turn.angle() * turn.axis();
}

Eigen::Matrix3d orthonormal(const Eigen::Matrix3d& R) { return Eigen::Quaterniond(R).normalized().toRotationMatrix(); }

double twist_about_z(const Eigen::Matrix3d& R) { return std::atan2(R(1, 0) - R(0, 1), R(0, 0) + R(1, 1)); }

}  // namespace tern
