// The result of a solver of the convex problem.
#pragma once

#include <functional>

#include "planner/optimization/trajectory_problem.h"

namespace tern {

struct ConvexSolution {
  bool found = false;          ///< a feasible point was found, x0 included; x is the best one
  bool solver_failed = false;  ///< the solver ended in error (found may still be true)
  FreeVariables x;
  double objective = 0.0;
  int iterations = 0;
  double gap = -1.0;  ///< certified: objective − optimum ≤ gap; negative without a certificate
};

/// Called once per iteration; true ends the solve with the best point so far.
using StopFunction = std::function<bool()>;

}  // namespace tern
