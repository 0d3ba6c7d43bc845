// A problem's derivatives as dense matrices.
#pragma once

#include <algorithm>
#include <vector>

#include "planner/optimization/nonlinear_problem.h"

namespace tern::support {

struct DenseDerivatives {
  Eigen::MatrixXd jacobian;
  Eigen::MatrixXd lagrangian_hessian;  ///< both triangles
};

/// Returns the derivatives at x.
inline DenseDerivatives dense_derivatives(const NonlinearProblem& problem, const Eigen::VectorXd& x, double factor,
                                          const Eigen::VectorXd& multipliers) {
  const SparsePattern& j = problem.jacobian_pattern();
  const SparsePattern& h = problem.hessian_pattern();
  std::vector<double> values(std::max(j.size(), h.size()));
  DenseDerivatives d{Eigen::MatrixXd::Zero(problem.bounds().size(), x.size()),
                     Eigen::MatrixXd::Zero(x.size(), x.size())};
  problem.jacobian(x, values.data());
  for (std::size_t e = 0; e < j.size(); ++e) d.jacobian(j.rows[e], j.columns[e]) += values[e];
  problem.hessian(x, factor, multipliers.data(), values.data());
  for (std::size_t e = 0; e < h.size(); ++e) {
    d.lagrangian_hessian(h.rows[e], h.columns[e]) += values[e];
    if (h.rows[e] != h.columns[e]) d.lagrangian_hessian(h.columns[e], h.rows[e]) += values[e];
  }
  return d;
}

}  // namespace tern::support
