#include "core/splines/minvo.h"

#include <Eigen/LU>
#include <cmath>

namespace tern {
namespace {

Eigen::Matrix4d make_basis_3() {
  Eigen::Matrix4d a;
  // clang-format off
  a << -3.4416308968564117,  6.9895481477801393, -4.4622887507045297,  0.91437149978080234,
        6.6792587327074839, -11.845989901556746,  5.2523596690684613,  0.0,
       -6.6792587327074839,  8.1917862965657040, -1.5981560640774179,  0.085628500219197656,
        3.4416308968564117, -3.3353445427890960,  0.80808514571348655, 0.0;
  // clang-format on
  return a;
}

Eigen::Matrix3d make_basis_2() {
  const double s = std::sqrt(3.0);
  Eigen::Matrix3d a;
  // clang-format off
  a <<  1.5, -(1.5 + s / 2.0), (4.0 + 2.0 * s) / 8.0,
       -3.0,  3.0,             0.0,
        1.5, -(1.5 - s / 2.0), (4.0 - 2.0 * s) / 8.0;
  // clang-format on
  return a;
}

}  // namespace

const Eigen::Matrix4d& minvo_basis_3() {
  static const Eigen::Matrix4d basis = make_basis_3();
  return basis;
}

const Eigen::Matrix3d& minvo_basis_2() {
  static const Eigen::Matrix3d basis = make_basis_2();
  return basis;
}

const Eigen::Matrix4d& minvo_inverse_3() {
  static const Eigen::Matrix4d inverse = minvo_basis_3().inverse();
  return inverse;
}

const Eigen::Matrix3d& minvo_inverse_2() {
  static const Eigen::Matrix3d inverse = minvo_basis_2().inverse();
  return inverse;
}

Points4 minvo_points(const PowerCubic& coefficients) {
  // The row of A⁻¹ for the constant is all ones. Adding the start last keeps large coordinates out of the products.
  const Points4 from_start = coefficients.leftCols<3>() * minvo_inverse_3().topRows<3>();
  return from_start.colwise() + coefficients.col(3);
}

}  // namespace tern
