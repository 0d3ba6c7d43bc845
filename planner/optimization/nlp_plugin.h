// The interface between planner/optimization and a solver in a shared object of its own (planner/ipopt). It is of C's
// types, and the solver needs nothing else of Tern. So each side has its own licences: see docs/licensing.md.
#pragma once

extern "C" {

/// min f(x) subject to c(x) ≤ bounds, with exact derivatives. Entries of the derivatives are given in the order of
/// their row and column numbers, of the Hessian those of the lower triangle. `problem` is the first argument of every
/// function.
struct TernNlp {
  void* problem;
  int variables, constraints;
  int jacobian_entries, hessian_entries;
  const int *jacobian_rows, *jacobian_columns;
  const int *hessian_rows, *hessian_columns;
  const double* start;   ///< x0
  const double* bounds;  ///< upper bounds of c
  double (*objective)(void* problem, const double* x);
  void (*gradient)(void* problem, const double* x, double* gradient);
  void (*constraint_values)(void* problem, const double* x, double* c);
  void (*jacobian)(void* problem, const double* x, double* entries);
  /// Of factor · f + multipliers · c.
  void (*hessian)(void* problem, const double* x, double factor, const double* multipliers, double* entries);
  int (*stop)(void* problem);  ///< called once per iteration; other than 0 ends the run
};

struct TernNlpRun {
  int failed;  ///< other than 0: ended in error
  int iterations;
};

/// The function that the shared object exports.
using TernNlpMinimise = TernNlpRun(const TernNlp* nlp, int max_iterations);
}

/// Its name, which ends in the version of this interface.
inline constexpr char kTernNlpMinimise[] = "tern_nlp_minimise_1";
