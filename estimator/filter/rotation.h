// Rotations by vectors: the exponential of SO(3), its inverse, and the integrals of it that motion needs.
#pragma once

#include "core/base/types.h"

namespace tern {

/// Returns [x]×, the matrix of the cross product: [x]× y = x × y.
inline Eigen::Matrix3d skew(const Vec3& x) {
  Eigen::Matrix3d S;
  S << 0.0, -x.z(), x.y(), x.z(), 0.0, -x.x(), -x.y(), x.x(), 0.0;
  return S;
}

/// Exp([φ]×) = Σ [φ]×ᵏ/k! and Γ_m = Σ [φ]×ᵏ/(k+m)!. Γ₁ is also the left Jacobian of SO(3).
struct RotationIntegrals {
  Eigen::Matrix3d exp;
  Eigen::Matrix3d first;   ///< Γ₁: a body acceleration a at the rate φ/h changes the velocity by R Γ₁ a h
  Eigen::Matrix3d second;  ///< Γ₂: and the position by R Γ₂ a h²
};
RotationIntegrals rotation_integrals(const Vec3& phi);

/// Returns Exp([φ]×).
Eigen::Matrix3d exp_rotation(const Vec3& phi);
/// Returns φ with Exp([φ]×) = R, |φ| ≤ π.
/// @pre R is a rotation
Vec3 log_rotation(const Eigen::Matrix3d& R);
/// Returns the rotation nearest to R, which differs from one by rounding.
Eigen::Matrix3d orthonormal(const Eigen::Matrix3d& R);
/// Returns the angle about z of the twist of R: for R = Rz(ψ) it is ψ; a small rotation φ has φ_z.
double twist_about_z(const Eigen::Matrix3d& R);

}  // namespace tern
