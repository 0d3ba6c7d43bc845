#include "core/world/pose_error.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/geometry/box.h"

namespace tern {

double PoseError::margin(const Vec3& x) const {
  const Eigen::Matrix<double, 6, 6> pose =
      Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(pose_covariance.data());
  const Vec3 r = x - position;
  Eigen::Matrix<double, 3, 6> J;
  J << 1.0, 0.0, 0.0, 0.0, r.z(), -r.y(),  //
      0.0, 1.0, 0.0, -r.z(), 0.0, r.x(),   //
      0.0, 0.0, 1.0, r.y(), -r.x(), 0.0;
  const Eigen::Matrix3d at_x = J * pose * J.transpose();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(at_x, Eigen::EigenvaluesOnly);  // in closed form: a plan asks for eight corners of each box
  const double largest = solver.eigenvalues()[2];
  return std::ceil((kQuantile * std::sqrt(std::max(largest, 0.0)) + apart) / kStep) * kStep;
}

double PoseError::margin(const Box& box) const {
  const Eigen::Matrix<double, 3, 8> corners = box_corners(box);
  double largest = 0.0;
  for (Eigen::Index k = 0; k < corners.cols(); ++k) largest = std::max(largest, margin(corners.col(k)));
  return largest;
}

}  // namespace tern
