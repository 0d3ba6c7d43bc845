// The bases whose control points enclose a cubic in their convex hull: MINVO, Bézier and B-spline. The MINVO hull is
// the smallest one. The other two serve comparisons.
#pragma once

#include "core/splines/clamped_spline.h"

namespace tern {

/// The basis by which hull points are computed.
enum class HullBasis { Minvo, Bezier, Bspline };

/// Returns the 4×4 matrix that turns power coefficients (3×4, of u³ u² u 1) into the control points of the basis.
/// Their hull contains the cubic over u ∈ [0, 1]. Bspline assumes uniform knots.
const Eigen::Matrix4d& hull_inverse_3(HullBasis basis);

/// Returns the 4×4 matrix that turns the control points q_j … q_{j+3} of a clamped spline into hull points of interval
/// j. For Bspline it is the identity. @throws std::out_of_range unless 0 ≤ j < J
Eigen::Matrix4d hull_of_interval(const SplineBasis& spline, HullBasis basis, int j);

/// Returns the same for dP/du, as a 4×3 matrix; divide the points by Δt for m/s. For Bspline they are the control
/// points of the derivative.
Eigen::Matrix<double, 4, 3> velocity_hull_of_interval(const SplineBasis& spline, HullBasis basis, int j);

/// The way in which hull points of a curve's intervals are computed.
struct HullForm {
  HullBasis basis = HullBasis::Minvo;
  int intervals = 0;  ///< J of the clamped spline; 0: there is none, and Bspline assumes uniform knots

  /// Returns the hull points of the part [u0, u1] of interval j, which is given as powers of u. For a proper part
  /// Bspline assumes uniform knots.
  [[nodiscard]] Points4 points(int j, const PowerCubic& power, double u0, double u1) const;
};

}  // namespace tern
