#include "core/splines/hull_basis.h"

#include <Eigen/LU>
#include <algorithm>

#include "core/splines/piecewise_cubic.h"

namespace tern {
namespace {

Eigen::Matrix4d bezier_inverse() {
  Eigen::Matrix4d basis;
  basis << -1, 3, -3, 1,  //
      3, -6, 3, 0,        //
      -3, 3, 0, 0,        //
      1, 0, 0, 0;
  return basis.inverse();
}

Eigen::Matrix4d bspline_inverse() {
  Eigen::Matrix4d basis;
  basis << -1, 3, -3, 1,  //
      3, -6, 0, 4,        //
      -3, 3, 3, 1,        //
      1, 0, 0, 0;
  return (basis / 6.0).inverse();
}

/// Knot τ_i of the clamped spline, in units of Δt.
double knot(int i, int intervals) { return std::clamp(i - 3, 0, intervals); }

}  // namespace

const Eigen::Matrix4d& hull_inverse_3(HullBasis basis) {
  static const Eigen::Matrix4d bezier = bezier_inverse();
  static const Eigen::Matrix4d bspline = bspline_inverse();
  if (basis == HullBasis::Minvo) return minvo_inverse_3();
  return basis == HullBasis::Bezier ? bezier : bspline;
}

Eigen::Matrix4d hull_of_interval(const SplineBasis& spline, HullBasis basis, int j) {
  if (basis == HullBasis::Minvo) return spline.position_minvo(j);
  const Eigen::Matrix4d& power = spline.power(j);
  if (basis == HullBasis::Bezier) return power * hull_inverse_3(basis);
  return Eigen::Matrix4d::Identity();
}

Eigen::Matrix<double, 4, 3> velocity_hull_of_interval(const SplineBasis& spline, HullBasis basis, int j) {
  if (basis == HullBasis::Minvo) return spline.velocity_minvo(j);
  if (basis == HullBasis::Bezier) return spline.velocity_bezier(j);
  Eigen::Matrix<double, 4, 3> differences = Eigen::Matrix<double, 4, 3>::Zero();
  for (int k = 0; k < 3; ++k) {
    const double span = knot(j + k + 4, spline.intervals()) - knot(j + k + 1, spline.intervals());
    differences(k, k) = -3.0 / span;
    differences(k + 1, k) = 3.0 / span;
  }
  return differences;
}

Points4 HullForm::points(int j, const PowerCubic& power, double u0, double u1) const {
  const bool whole = u0 == 0.0 && u1 == 1.0;
  if (whole && basis == HullBasis::Bspline && intervals > 0) return power * spline_basis(intervals).power(j).inverse();
  return (whole ? power : reparametrized(power, u0, u1)) * hull_inverse_3(basis);
}

}  // namespace tern
