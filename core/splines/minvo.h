// The MINVO basis: its control points are the vertices of the smallest simplex that contains a polynomial curve.
// Source: J. Tordesillas and J. P. How, "MINVO basis: finding simplexes with minimum volume enclosing polynomial
// curves". The numbers stand in docs/reference/notation.md.
#pragma once

#include <Eigen/Core>

namespace tern {

using Points4 = Eigen::Matrix<double, 3, 4>;     ///< a point per column
using Points3 = Eigen::Matrix<double, 3, 3>;     ///< a point per column
using PowerCubic = Eigen::Matrix<double, 3, 4>;  ///< coefficients of u³ u² u 1, a row per axis

/// Returns the matrix A of degree 3 or 2, with P(u) = V · A · [u^N … u 1]ᵀ for u ∈ [0, 1]. Rows are basis polynomials,
/// columns are powers of u, the highest first.
///
/// The basis polynomials are ≥ 0 on [0, 1] and sum to 1, both up to rounding (about 1e-15). The curve therefore lies
/// in the convex hull of V's columns. For degree 3 this simplex is 2.36 times smaller than the Bernstein one and 254.9
/// times smaller than the one of the uniform B-spline. Degree 2 is a closed form, degree 3 the published numeric
/// optimum.
const Eigen::Matrix4d& minvo_basis_3();
const Eigen::Matrix3d& minvo_basis_2();

/// Returns A⁻¹. MINVO points are power coefficients (3×(N+1), the highest power first) times A⁻¹.
const Eigen::Matrix4d& minvo_inverse_3();
const Eigen::Matrix3d& minvo_inverse_2();

/// Returns the four MINVO points V = c · A⁻¹ of the cubic c · [u³ u² u 1]ᵀ over u ∈ [0, 1]; their hull contains it.
/// They are computed relative to the start of the piece, so a piece 10 km from the origin keeps all digits of its
/// shape.
Points4 minvo_points(const PowerCubic& coefficients);

}  // namespace tern
