// The convex problem of `alternating` by a dense primal-dual barrier method of our own: small, exact about its answer.
#pragma once

#include <memory>

#include "planner/optimization/convex_problem.h"
#include "planner/optimization/convex_solution.h"

namespace tern {

/// Ends when the certified gap is at most this share of |objective|, or kGapAbsolute.
inline constexpr double kGapShare = 1e-5;
inline constexpr double kGapAbsolute = 1e-8;  ///< m², objectives are in ω_g m²

/// Minimises from x0, which need not be strictly feasible: the search's result lies on every bound widened to it.
///
/// Mehrotra's predictor-corrector on the perturbed conditions of optimality. With constraints c_i(x) ≤ 0 (rows scaled
/// to unit length, spheres (‖W_k x + p_k‖² − r²)/2r: both in metres), slacks s > 0 and multipliers λ > 0:
///
///     ∇f(x) + Σ λ_i ∇c_i(x) = 0,   c(x) + s = 0,   s_i λ_i = σμ
///
/// A step solves (∇²L + Jᵀ diag(λ/s) J) Δx = …, a dense symmetric system of 3(J − 2) variables, by Cholesky, twice with
/// one factor. Slacks start at no less than kMinFirstSlack, so iterates may leave the feasible set at first. Those
/// strictly inside are kept, so that the solve can be ended at any time. For such an x weak duality gives a bound that
/// needs no trust in the iteration: f is at least as curved as H, so
///
///     f(x) − f*  ≤  Σ λ_i (−c_i(x)) + ½ rᵀ H⁻¹ r,   r = ∇f(x) + Σ λ_i ∇c_i(x).
///
/// One order of operations, no BLAS, no libm but sqrt: the same problem gives the same bits. O(rows · nonzeros² + n³)
/// per step. `solver_failed`: no pivot, or no step left before the gap closed.
///
/// Keeps its arrays: a problem that is no larger than those before it allocates nothing. Not for two calls at once.
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
