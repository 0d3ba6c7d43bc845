// A dense primal-dual barrier method for the convex problem of `alternating`, with a certified gap. See
// docs/planner/optimization.md.
#pragma once

#include <memory>

#include "planner/optimization/convex_problem.h"
#include "planner/optimization/convex_solution.h"

namespace tern {

/// The solver ends when the certified gap is at most kGapShare · |objective|, or at most kGapAbsolute.
inline constexpr double kGapShare = 1e-5;
inline constexpr double kGapAbsolute = 1e-8;  ///< in units of the objective, ω_g m²

/// Minimises from x0. x0 may be infeasible; the search's result lies on every bound that was widened to it.
///
/// The method is Mehrotra's predictor-corrector on the perturbed optimality conditions. The constraints are c_i(x) ≤ 0:
/// rows scaled to unit length, and spheres as (‖W_k x + p_k‖² − r²)/2r, so both are in metres. With slacks s > 0 and
/// multipliers λ > 0:
///
///     ∇f(x) + Σ λ_i ∇c_i(x) = 0,   c(x) + s = 0,   s_i λ_i = σμ
///
/// A step solves (∇²L + Jᵀ diag(λ/s) J) Δx = …, a dense symmetric system of 3(J − 2) variables, by Cholesky: twice with
/// one factor. Slacks start at kMinFirstSlack or more, so the first iterates may be infeasible. Every strictly feasible
/// iterate is kept, so the solve can be stopped at any time.
///
/// For a feasible x, weak duality bounds the gap without trust in the iteration, since f is at least as curved as H:
///
///     f(x) − f*  ≤  Σ λ_i (−c_i(x)) + ½ rᵀ H⁻¹ r,   r = ∇f(x) + Σ λ_i ∇c_i(x).
///
/// The order of operations is fixed, without BLAS, and of libm only sqrt is used: the same problem gives the same bits.
/// A step costs O(rows · nonzeros² + n³). `solver_failed` means that a factorization failed, or that the steps became
/// too short before the gap was small enough.
///
/// The solver allocates only for a problem larger than all before. One object serves one call at a time.
class BarrierSolver {
 public:
  BarrierSolver();
  ~BarrierSolver();
  BarrierSolver(BarrierSolver&&) noexcept;

  ConvexSolution solve(const ConvexProblem& problem, const FreeVariables& x0, int max_iterations,
                       const StopFunction& stop);

 private:
  class Iteration;
  std::unique_ptr<Iteration> iteration_;
};

}  // namespace tern
