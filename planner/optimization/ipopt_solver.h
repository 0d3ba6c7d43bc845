// Ipopt behind two functions. The only Ipopt in Tern; not safe from two threads at once (MUMPS).
#pragma once

#include "planner/optimization/convex_solution.h"
#include "planner/optimization/nonlinear_problem.h"

namespace tern {

/// How a run of Ipopt ended; its points were shown on the way.
struct IpoptRun {
  bool failed = false;  ///< in error: not solved, not to an acceptable level, not stopped, iterations not used up
  int iterations = 0;
};

/// Shown x and c(x), first for x0, then wherever Ipopt evaluates the constraints: what is to be kept is the caller's to
/// decide.
using Visit = std::function<void(const Eigen::VectorXd& x, const Eigen::VectorXd& constraints)>;

/// Minimises from x0 with exact derivatives. @param stop  asked once per iteration
IpoptRun minimise_by_ipopt(const NonlinearProblem& problem, const Eigen::VectorXd& x0, int max_iterations,
                           const StopFunction& stop, const Visit& visit);

/// The convex problem from x0; every feasible point that Ipopt evaluates is a candidate, so the solve can be ended at
/// any time. No certified gap.
ConvexSolution solve_by_ipopt(const ConvexProblem& problem, const FreeVariables& x0, int max_iterations,
                              const StopFunction& stop);

}  // namespace tern
