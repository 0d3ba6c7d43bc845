// What a solver of the convex problem answers.
#pragma once

#include <functional>

#include "planner/optimization/trajectory_problem.h"

namespace tern {

struct ConvexSolution {
  bool found = false;          ///< some feasible point was seen (x0 counts); x is the best of them
  bool solver_failed = false;  ///< the solver ended in error (found may still be true)
  FreeVariables x;
  double objective = 0.0;
  int iterations = 0;
  double gap = -1.0;  ///< certified: objective − optimum ≤ gap; < 0: no certificate
};

/// Asked once per iteration; true ends the solve with the best so far.
using StopFunction = std::function<bool()>;

}  // namespace tern
