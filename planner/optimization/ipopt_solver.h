// Ipopt behind two functions. Not thread-safe, because of MUMPS.
//
// Ipopt is not linked: it is in tern-ipopt.so (planner/ipopt), which the first call loads. That file is looked for
// beside the program or the library that holds this code, then in lib/…/tern of their installation.
#pragma once

#include <string>

#include "planner/optimization/convex_solution.h"
#include "planner/optimization/nonlinear_problem.h"

namespace tern {

/// Returns why Ipopt cannot be used, and the remedy; "" if it can.
const std::string& why_no_ipopt();

/// The end of a run of Ipopt. Its points were passed to the Visit function.
struct IpoptRun {
  bool failed = false;  ///< ended in error: neither solved, nor acceptable, nor stopped, nor out of iterations
  int iterations = 0;
};

/// Called with x and c(x), first for x0, then for each x at which Ipopt evaluates the constraints. The caller decides
/// which to keep.
using Visit = std::function<void(const Eigen::VectorXd& x, const Eigen::VectorXd& constraints)>;

/// Minimises from x0 with exact derivatives. @param stop  called once per iteration
/// @throws std::runtime_error with why_no_ipopt() if Ipopt cannot be used
IpoptRun minimise_by_ipopt(const NonlinearProblem& problem, const Eigen::VectorXd& x0, int max_iterations,
                           const StopFunction& stop, const Visit& visit);

/// Solves the convex problem from x0. Every feasible point that Ipopt evaluates is a candidate, so the solve can be
/// stopped at any time. There is no certified gap.
/// @throws std::runtime_error as minimise_by_ipopt()
ConvexSolution solve_by_ipopt(const ConvexProblem& problem, const FreeVariables& x0, int max_iterations,
                              const StopFunction& stop);

}  // namespace tern
