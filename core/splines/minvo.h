// The MINVO basis (Tordesillas and How): the simplex of least volume that encloses a polynomial piece. Reference numbers: docs/notation.md.
#pragma once

#include <Eigen/Core>

namespace tern {

/// A for degree N: rows are basis polynomials, columns u^N … u 1, u ∈ [0, 1]. P(u) = V · A · [u^N … 1]ᵀ.
const Eigen::Matrix4d& minvo_basis_3();
const Eigen::Matrix3d& minvo_basis_2();
const Eigen::Matrix2d& minvo_basis_1();

/// A⁻¹: MINVO points = power coefficients (3×(N+1), highest power first) · A⁻¹.
const Eigen::Matrix4d& minvo_inverse_3();
const Eigen::Matrix3d& minvo_inverse_2();

}  // namespace tern
