// Whose control points hold a cubic in their hull: MINVO, Bézier or the B-spline's own. MINVO is the tightest.
#pragma once

#include "core/splines/clamped_spline.h"

namespace tern {

enum class HullBasis { Minvo, Bezier, Bspline };

/// Power coefficients (3×4, of u³ u² u 1) times this are the basis's control points of the cubic over u ∈ [0, 1]. Their
/// hull holds it there. Bspline: of uniform knots.
const Eigen::Matrix4d& hull_inverse_3(HullBasis basis);

/// The four control points q_j … q_{j+3} of a clamped spline times this are hull points of interval j. Bspline: those
/// themselves. @throws std::out_of_range unless 0 ≤ j < J.
Eigen::Matrix4d hull_of_interval(const SplineBasis& spline, HullBasis basis, int j);

/// The same for dP/du; divide by Δt for m/s. Bspline: the derivative's control points.
Eigen::Matrix<double, 4, 3> velocity_hull_of_interval(const SplineBasis& spline, HullBasis basis, int j);

/// How hulls of a curve's intervals are made.
struct HullForm {
  HullBasis basis = HullBasis::Minvo;
  int intervals = 0;  ///< J of the clamped spline that the intervals are of; 0: none, Bspline takes uniform knots

  /// The hull points of the part [u0, u1] of interval j, given as powers of u. Bspline: of parts with uniform knots.
  [[nodiscard]] Points4 points(int j, const PowerCubic& power, double u0, double u1) const;
};

}  // namespace tern
