// The convex problem of `alternating` by Ipopt. The only Ipopt in Tern; not safe from two threads at once (MUMPS).
#pragma once

#include "planner/optimization/convex_problem.h"
#include "planner/optimization/convex_solution.h"

namespace tern {

/// Minimises from x0; every iterate that Ipopt evaluates is harvested if it is feasible, so that the answer is anytime.
/// @param stop  asked once per iteration; true ends the solve with the best so far.
/// Exact derivatives: ∇f = H x + g; rows constant; ∇‖p_k‖² = 2 W_kᵀ p_k with Hessian 2 W_kᵀ W_k.
ConvexSolution solve_by_ipopt(const ConvexProblem& problem, const Eigen::VectorXd& x0, int max_iterations,
                              const StopFunction& stop);

/// The derivatives that Ipopt is given, for tests: constraint values, Jacobian, Hessian of the Lagrangian.
struct ConvexDerivatives {
  Eigen::VectorXd constraints;  ///< rows·x, then ‖p_k‖²
  Eigen::MatrixXd jacobian;
  Eigen::MatrixXd lagrangian_hessian;  ///< objective_factor·H + Σ multipliers · ∇²constraint
};
ConvexDerivatives derivatives_for_ipopt(const ConvexProblem& problem, const Eigen::VectorXd& x, double objective_factor,
                                        const Eigen::VectorXd& multipliers);

}  // namespace tern
