#include "planner/optimization/ipopt_solver.h"

#include <IpIpoptApplication.hpp>
#include <IpTNLP.hpp>
#include <algorithm>

namespace tern {
namespace {

using Ipopt::Index;
using Ipopt::Number;

constexpr double kNoBound = 2e19;  // Ipopt's infinity

class Nlp final : public Ipopt::TNLP {
 public:
  Nlp(const NonlinearProblem& problem, const Eigen::VectorXd& x0, const StopFunction& stop, const Visit& visit)
      : p_(problem), x0_(x0), stop_(stop), visit_(visit) {
    visit_(x0, p_.constraints(x0));
  }

  [[nodiscard]] int iterations() const { return iterations_; }

  bool get_nlp_info(Index& n, Index& m, Index& jacobian_entries, Index& hessian_entries,
                    IndexStyleEnum& style) override {
    n = p_.variables();
    m = static_cast<Index>(p_.bounds().size());
    jacobian_entries = static_cast<Index>(p_.jacobian_pattern().size());
    hessian_entries = static_cast<Index>(p_.hessian_pattern().size());
    style = C_STYLE;
    return true;
  }

  bool get_bounds_info(Index n, Number* x_low, Number* x_high, Index m, Number* g_low, Number* g_high) override {
    std::fill_n(x_low, n, -kNoBound);
    std::fill_n(x_high, n, kNoBound);
    std::fill_n(g_low, m, -kNoBound);
    std::copy_n(p_.bounds().data(), m, g_high);
    return true;
  }

  bool get_starting_point(Index n, bool, Number* x, bool, Number*, Number*, Index, bool, Number*) override {
    std::copy_n(x0_.data(), n, x);
    return true;
  }

  bool eval_f(Index n, const Number* x, bool, Number& value) override {
    value = p_.objective(view(x, n));
    return true;
  }

  bool eval_grad_f(Index n, const Number* x, bool, Number* gradient) override {
    Eigen::Map<Eigen::VectorXd>(gradient, n) = p_.gradient(view(x, n));
    return true;
  }

  bool eval_g(Index n, const Number* x, bool, Index m, Number* g) override {
    const Eigen::VectorXd at = view(x, n);
    const Eigen::VectorXd constraints = p_.constraints(at);
    std::copy_n(constraints.data(), m, g);
    visit_(at, constraints);
    return true;
  }

  bool eval_jac_g(Index n, const Number* x, bool, Index, Index, Index* rows, Index* columns, Number* values) override {
    if (values == nullptr)
      copy(p_.jacobian_pattern(), rows, columns);
    else
      p_.jacobian(view(x, n), values);
    return true;
  }

  bool eval_h(Index n, const Number* x, bool, Number factor, Index, const Number* multipliers, bool, Index, Index* rows,
              Index* columns, Number* values) override {
    if (values == nullptr)
      copy(p_.hessian_pattern(), rows, columns);
    else
      p_.hessian(view(x, n), factor, multipliers, values);
    return true;
  }

  bool intermediate_callback(Ipopt::AlgorithmMode, Index iteration, Number, Number, Number, Number, Number, Number,
                             Number, Number, Index, const Ipopt::IpoptData*,
                             Ipopt::IpoptCalculatedQuantities*) override {
    iterations_ = iteration;
    return !stop_();
  }

  void finalize_solution(Ipopt::SolverReturn, Index, const Number*, const Number*, const Number*, Index, const Number*,
                         const Number*, Number, const Ipopt::IpoptData*, Ipopt::IpoptCalculatedQuantities*) override {}

 private:
  static Eigen::VectorXd view(const Number* x, Index n) { return Eigen::Map<const Eigen::VectorXd>(x, n); }

  static void copy(const SparsePattern& pattern, Index* rows, Index* columns) {
    std::copy(pattern.rows.begin(), pattern.rows.end(), rows);
    std::copy(pattern.columns.begin(), pattern.columns.end(), columns);
  }

  const NonlinearProblem& p_;
  Eigen::VectorXd x0_;
  const StopFunction& stop_;
  const Visit& visit_;
  int iterations_ = 0;
};

/// Sets the options, tuned on recorded problems. The monotone barrier from 1e-2 and the AMD ordering of MUMPS take half
/// the time of Ipopt's defaults.
void set_options(Ipopt::IpoptApplication& app, int max_iterations) {
  const auto options = app.Options();
  options->SetIntegerValue("print_level", 0);
  options->SetStringValue("sb", "yes");
  options->SetIntegerValue("max_iter", max_iterations);
  options->SetNumericValue("tol", 1e-6);
  options->SetNumericValue("bound_relax_factor", 0.0);
  options->SetStringValue("mu_strategy", "monotone");
  options->SetNumericValue("mu_init", 1e-2);
  options->SetIntegerValue("mumps_pivot_order", 0);
  options->SetStringValue("nlp_scaling_method", "none");
}

}  // namespace

IpoptRun minimise_by_ipopt(const NonlinearProblem& problem, const Eigen::VectorXd& x0, int max_iterations,
                           const StopFunction& stop, const Visit& visit) {
  Ipopt::SmartPtr<Ipopt::IpoptApplication> app = new Ipopt::IpoptApplication(false);
  set_options(*app, max_iterations);
  if (app->Initialize("") != Ipopt::Solve_Succeeded) return {true, 0};
  Ipopt::SmartPtr<Nlp> nlp = new Nlp(problem, x0, stop, visit);
  const Ipopt::ApplicationReturnStatus status = app->OptimizeTNLP(Ipopt::SmartPtr<Ipopt::TNLP>(GetRawPtr(nlp)));
  const bool failed = status != Ipopt::Solve_Succeeded && status != Ipopt::Solved_To_Acceptable_Level &&
                      status != Ipopt::User_Requested_Stop && status != Ipopt::Maximum_Iterations_Exceeded;
  return {failed, nlp->iterations()};
}

ConvexSolution solve_by_ipopt(const ConvexProblem& problem, const FreeVariables& x0, int max_iterations,
                              const StopFunction& stop) {
  ConvexSolution best;
  const auto keep_if_best = [&](const Eigen::VectorXd& x, const Eigen::VectorXd&) {
    if (!(problem.worst_violation(x) <= 0.0)) return;
    const double objective = problem.objective(x);
    if (best.found && objective >= best.objective) return;
    best.found = true;
    best.x = x;
    best.objective = objective;
  };
  const IpoptRun run = minimise_by_ipopt(ConvexAsNonlinear(problem), x0, max_iterations, stop, keep_if_best);
  best.solver_failed = run.failed;
  best.iterations = run.iterations;
  return best;
}

}  // namespace tern
