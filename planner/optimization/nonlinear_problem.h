// A smooth problem for a general solver: values and exact sparse derivatives.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "planner/optimization/convex_problem.h"

namespace tern {

/// The entries of a matrix that can be non-zero, in the order of their values.
struct SparsePattern {
  std::vector<int> rows, columns;

  [[nodiscard]] std::size_t size() const { return rows.size(); }
  void add(int row, int column) {
    rows.push_back(row);
    columns.push_back(column);
  }
};

/// min f(x)   subject to   c(x) ≤ b.
class NonlinearProblem {
 public:
  virtual ~NonlinearProblem() = default;
  [[nodiscard]] virtual int variables() const = 0;
  [[nodiscard]] const Eigen::VectorXd& bounds() const { return bounds_; }  ///< b
  [[nodiscard]] const SparsePattern& jacobian_pattern() const { return jacobian_pattern_; }
  [[nodiscard]] const SparsePattern& hessian_pattern() const { return hessian_pattern_; }  ///< lower triangle
  [[nodiscard]] virtual double objective(const Eigen::VectorXd& x) const = 0;
  [[nodiscard]] virtual Eigen::VectorXd gradient(const Eigen::VectorXd& x) const = 0;     ///< ∇f
  [[nodiscard]] virtual Eigen::VectorXd constraints(const Eigen::VectorXd& x) const = 0;  ///< c
  /// Writes ∇c, one value per entry of jacobian_pattern().
  virtual void jacobian(const Eigen::VectorXd& x, double* values) const = 0;
  /// Writes factor ∇²f + Σ multiplier_i ∇²c_i, one value per entry of hessian_pattern().
  virtual void hessian(const Eigen::VectorXd& x, double factor, const double* multipliers, double* values) const = 0;

 protected:
  Eigen::VectorXd bounds_;
  SparsePattern jacobian_pattern_, hessian_pattern_;
};

/// A ConvexProblem as a NonlinearProblem: c stacks A x and ‖W_k x + p_k‖², with the gradients A and 2 W_kᵀ(W_k x +
/// p_k).
class ConvexAsNonlinear final : public NonlinearProblem {
 public:
  explicit ConvexAsNonlinear(const ConvexProblem& problem);  ///< must outlive this object

  [[nodiscard]] int variables() const override { return p_.variables(); }
  [[nodiscard]] double objective(const Eigen::VectorXd& x) const override { return p_.objective(x); }
  [[nodiscard]] Eigen::VectorXd gradient(const Eigen::VectorXd& x) const override;
  [[nodiscard]] Eigen::VectorXd constraints(const Eigen::VectorXd& x) const override;
  void jacobian(const Eigen::VectorXd& x, double* values) const override;
  void hessian(const Eigen::VectorXd& x, double factor, const double* multipliers, double* values) const override;

 private:
  const ConvexProblem& p_;
};

}  // namespace tern
