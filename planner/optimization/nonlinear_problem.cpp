#include "planner/optimization/nonlinear_problem.h"

namespace tern {

ConvexAsNonlinear::ConvexAsNonlinear(const ConvexProblem& problem) : p_(problem) {
  const int rows = p_.row_count();
  const int n = p_.variables();
  bounds_.resize(rows + p_.spheres());
  bounds_.head(rows) = Eigen::Map<const Eigen::VectorXd>(p_.bounds.data(), rows);
  bounds_.tail(p_.spheres()).setConstant(p_.sphere_radius2);
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < n; ++c) {
      if (p_.row(r)[c] != 0.0) jacobian_pattern_.add(r, c);
    }
  }
  for (int k = 0; k < p_.spheres(); ++k) {
    for (int c = 0; c < n; ++c) {
      if (p_.sphere_weight(k, c) != 0.0) jacobian_pattern_.add(rows + k, c);
    }
  }
  for (int r = 0; r < n; ++r) {
    for (int c = r % 3; c <= r; c += 3) hessian_pattern_.add(r, c);  // axes are independent
  }
}

Eigen::VectorXd ConvexAsNonlinear::gradient(const Eigen::VectorXd& x) const { return p_.hessian * x + p_.gradient; }

Eigen::VectorXd ConvexAsNonlinear::constraints(const Eigen::VectorXd& x) const {
  Eigen::VectorXd c(bounds_.size());
  for (int r = 0; r < p_.row_count(); ++r) c[r] = p_.row_times(r, x);
  for (int k = 0; k < p_.spheres(); ++k) c[p_.row_count() + k] = p_.sphere_point(k, x).squaredNorm();
  return c;
}

void ConvexAsNonlinear::jacobian(const Eigen::VectorXd& x, double* values) const {
  const int rows = p_.row_count();
  Points at(3, p_.spheres());
  for (int k = 0; k < p_.spheres(); ++k) at.col(k) = p_.sphere_point(k, x);
  for (std::size_t e = 0; e < jacobian_pattern_.size(); ++e) {
    const int row = jacobian_pattern_.rows[e];
    const int column = jacobian_pattern_.columns[e];
    values[e] =
        row < rows ? p_.row(row)[column] : 2.0 * p_.sphere_weight(row - rows, column) * at(column % 3, row - rows);
  }
}

void ConvexAsNonlinear::hessian(const Eigen::VectorXd&, double factor, const double* multipliers,
                                double* values) const {
  for (std::size_t e = 0; e < hessian_pattern_.size(); ++e) {
    const int row = hessian_pattern_.rows[e];
    const int column = hessian_pattern_.columns[e];
    double h = factor * p_.hessian(row, column);
    for (int k = 0; k < p_.spheres(); ++k) {
      h += multipliers[p_.row_count() + k] * 2.0 * p_.sphere_weight(k, row) * p_.sphere_weight(k, column);
    }
    values[e] = h;
  }
}

}  // namespace tern
