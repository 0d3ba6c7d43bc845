#include "core/world/stated_bound.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace tern {

Eigen::Matrix3d position_covariance(const std::array<double, 36>& pose_covariance) {
  Eigen::Matrix3d covariance;
  for (int k = 0; k < 9; ++k) covariance(k / 3, k % 3) = pose_covariance[idx(6 * (k / 3) + k % 3)];
  return covariance;
}

double stated_bound(const std::array<double, 36>& pose_covariance) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(position_covariance(pose_covariance),
                                                              Eigen::EigenvaluesOnly);
  return std::sqrt(kChiSquared3 * std::max(solver.eigenvalues()[2], 0.0));
}

}  // namespace tern
