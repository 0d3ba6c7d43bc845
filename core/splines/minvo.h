// The MINVO basis: for a polynomial piece, the control points of the enclosing simplex of least volume.
// J. Tordesillas and J. P. How, "MINVO basis: finding simplexes with minimum volume enclosing polynomial curves".
#pragma once

#include <Eigen/Core>

namespace tern {

using Points4 = Eigen::Matrix<double, 3, 4>;     ///< a point per column
using Points3 = Eigen::Matrix<double, 3, 3>;     ///< a point per column
using PowerCubic = Eigen::Matrix<double, 3, 4>;  ///< coefficients of u³ u² u 1, a row per axis

/// A for degree N: rows are basis polynomials, columns u^N … u 1, u ∈ [0, 1]. P(u) = V · A · [u^N … 1]ᵀ.
///
/// Each basis polynomial is ≥ 0 on [0, 1] and they sum to 1, so that the curve lies in the convex hull of V's columns.
/// For degree 3 that simplex is 2.36 times smaller than Bernstein's and 254.9 times smaller than the uniform
/// B-spline's. Both properties hold to rounding (about 1e-15); degree 2 is a closed form, degree 3 is the
/// published numeric optimum.
const Eigen::Matrix4d& minvo_basis_3();
const Eigen::Matrix3d& minvo_basis_2();

/// A⁻¹: MINVO points = power coefficients (3×(N+1), highest power first) · A⁻¹.
const Eigen::Matrix4d& minvo_inverse_3();
const Eigen::Matrix3d& minvo_inverse_2();

/// The four MINVO points of the cubic piece c·[u³ u² u 1]ᵀ over u ∈ [0, 1]: their hull contains the piece. V = c · A⁻¹,
/// computed from the piece's own start, so that a piece 10 km from the origin loses no digits of its shape.
Points4 minvo_points(const PowerCubic& coefficients);

}  // namespace tern
