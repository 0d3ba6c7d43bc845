#include "planner/optimization/ipopt_solver.h"

#include <IpIpoptApplication.hpp>
#include <IpTNLP.hpp>
#include <algorithm>
#include <vector>

namespace tern {
namespace {

using Ipopt::Index;
using Ipopt::Number;

constexpr double kNoBound = 2e19;  // Ipopt's infinity

/// Entries of the Jacobian and of the Hessian's lower triangle that can be non-zero, row by row.
struct Pattern {
  std::vector<Index> jacobian_rows, jacobian_columns, hessian_rows, hessian_columns;
};

Pattern make_pattern(const ConvexProblem& p) {
  Pattern pattern;
  const auto n = static_cast<Index>(p.variables());
  for (Eigen::Index r = 0; r < p.rows.rows(); ++r) {
    for (Index c = 0; c < n; ++c) {
      if (p.rows(r, c) == 0.0) continue;
      pattern.jacobian_rows.push_back(static_cast<Index>(r));
      pattern.jacobian_columns.push_back(c);
    }
  }
  for (int k = 0; k < p.spheres(); ++k) {
    for (Index c = 0; c < n; ++c) {
      if (p.sphere_weights(k, c / 3) == 0.0) continue;
      pattern.jacobian_rows.push_back(static_cast<Index>(p.rows.rows()) + k);
      pattern.jacobian_columns.push_back(c);
    }
  }
  for (Index r = 0; r < n; ++r) {
    for (Index c = r % 3; c <= r; c += 3) {  // axes do not mix
      pattern.hessian_rows.push_back(r);
      pattern.hessian_columns.push_back(c);
    }
  }
  return pattern;
}

double jacobian_entry(const ConvexProblem& p, const Eigen::VectorXd& x, Index row, Index column) {
  if (row < p.rows.rows()) return p.rows(row, column);
  const int k = row - static_cast<Index>(p.rows.rows());
  return 2.0 * p.sphere_weights(k, column / 3) * p.sphere_point(k, x)[column % 3];
}

double hessian_entry(const ConvexProblem& p, double factor, const double* multipliers, Index row, Index column) {
  double h = factor * p.hessian(row, column);
  for (int k = 0; k < p.spheres(); ++k) {
    h += multipliers[p.rows.rows() + k] * 2.0 * p.sphere_weights(k, row / 3) * p.sphere_weights(k, column / 3);
  }
  return h;
}

Eigen::VectorXd constraint_values(const ConvexProblem& p, const Eigen::VectorXd& x) {
  Eigen::VectorXd g(p.rows.rows() + p.spheres());
  g.head(p.rows.rows()) = p.rows * x;
  for (int k = 0; k < p.spheres(); ++k) g[p.rows.rows() + k] = p.sphere_point(k, x).squaredNorm();
  return g;
}

class Nlp final : public Ipopt::TNLP {
 public:
  Nlp(const ConvexProblem& problem, const Eigen::VectorXd& x0, const StopFunction& stop)
      : p_(problem), pattern_(make_pattern(problem)), x0_(x0), stop_(stop) {
    harvest(x0);
  }

  [[nodiscard]] const ConvexSolution& best() const { return best_; }

  bool get_nlp_info(Index& n, Index& m, Index& jacobian_entries, Index& hessian_entries,
                    IndexStyleEnum& style) override {
    n = static_cast<Index>(p_.variables());
    m = static_cast<Index>(p_.rows.rows()) + p_.spheres();
    jacobian_entries = static_cast<Index>(pattern_.jacobian_rows.size());
    hessian_entries = static_cast<Index>(pattern_.hessian_rows.size());
    style = C_STYLE;
    return true;
  }

  bool get_bounds_info(Index n, Number* x_low, Number* x_high, Index m, Number* g_low, Number* g_high) override {
    std::fill_n(x_low, n, -kNoBound);
    std::fill_n(x_high, n, kNoBound);
    std::fill_n(g_low, m, -kNoBound);
    std::copy_n(p_.bounds.data(), p_.bounds.size(), g_high);
    std::fill(g_high + p_.bounds.size(), g_high + m, p_.sphere_radius2);
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
    Eigen::Map<Eigen::VectorXd>(gradient, n) = p_.hessian * view(x, n) + p_.gradient;
    return true;
  }

  bool eval_g(Index n, const Number* x, bool, Index m, Number* g) override {
    const Eigen::VectorXd at = view(x, n);
    Eigen::Map<Eigen::VectorXd>(g, m) = constraint_values(p_, at);
    harvest(at);
    return true;
  }

  bool eval_jac_g(Index n, const Number* x, bool, Index, Index entries, Index* rows, Index* columns,
                  Number* values) override {
    if (values == nullptr) {
      std::copy(pattern_.jacobian_rows.begin(), pattern_.jacobian_rows.end(), rows);
      std::copy(pattern_.jacobian_columns.begin(), pattern_.jacobian_columns.end(), columns);
      return true;
    }
    const Eigen::VectorXd at = view(x, n);
    for (Index i = 0; i < entries; ++i) {
      const auto k = static_cast<std::size_t>(i);
      values[i] = jacobian_entry(p_, at, pattern_.jacobian_rows[k], pattern_.jacobian_columns[k]);
    }
    return true;
  }

  bool eval_h(Index, const Number*, bool, Number factor, Index, const Number* multipliers, bool, Index entries,
              Index* rows, Index* columns, Number* values) override {
    if (values == nullptr) {
      std::copy(pattern_.hessian_rows.begin(), pattern_.hessian_rows.end(), rows);
      std::copy(pattern_.hessian_columns.begin(), pattern_.hessian_columns.end(), columns);
      return true;
    }
    for (Index i = 0; i < entries; ++i) {
      const auto k = static_cast<std::size_t>(i);
      values[i] = hessian_entry(p_, factor, multipliers, pattern_.hessian_rows[k], pattern_.hessian_columns[k]);
    }
    return true;
  }

  bool intermediate_callback(Ipopt::AlgorithmMode, Index iteration, Number, Number, Number, Number, Number, Number,
                             Number, Number, Index, const Ipopt::IpoptData*,
                             Ipopt::IpoptCalculatedQuantities*) override {
    best_.iterations = iteration;
    return !stop_();
  }

  void finalize_solution(Ipopt::SolverReturn, Index, const Number*, const Number*, const Number*, Index, const Number*,
                         const Number*, Number, const Ipopt::IpoptData*, Ipopt::IpoptCalculatedQuantities*) override {}

 private:
  static Eigen::Map<const Eigen::VectorXd> view(const Number* x, Index n) { return {x, n}; }

  void harvest(const Eigen::VectorXd& x) {
    if (p_.worst_violation(x) > 0.0) return;
    const double objective = p_.objective(x);
    if (best_.found && objective >= best_.objective) return;
    best_.found = true;
    best_.x = x;
    best_.objective = objective;
  }

  const ConvexProblem& p_;
  Pattern pattern_;
  Eigen::VectorXd x0_;
  const StopFunction& stop_;
  ConvexSolution best_;
};

/// Tuned on recorded problems: the monotone barrier from 1e-2 and MUMPS's AMD ordering halve the time against Ipopt's
/// defaults.
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

ConvexSolution solve_by_ipopt(const ConvexProblem& problem, const Eigen::VectorXd& x0, int max_iterations,
                              const StopFunction& stop) {
  Ipopt::SmartPtr<Ipopt::IpoptApplication> app = new Ipopt::IpoptApplication(false);
  set_options(*app, max_iterations);
  ConvexSolution failed;
  failed.solver_failed = true;
  if (app->Initialize("") != Ipopt::Solve_Succeeded) return failed;
  Ipopt::SmartPtr<Nlp> nlp = new Nlp(problem, x0, stop);
  const Ipopt::ApplicationReturnStatus status = app->OptimizeTNLP(Ipopt::SmartPtr<Ipopt::TNLP>(GetRawPtr(nlp)));
  ConvexSolution solution = nlp->best();
  solution.solver_failed = status != Ipopt::Solve_Succeeded && status != Ipopt::Solved_To_Acceptable_Level &&
                           status != Ipopt::User_Requested_Stop && status != Ipopt::Maximum_Iterations_Exceeded;
  return solution;
}

ConvexDerivatives derivatives_for_ipopt(const ConvexProblem& problem, const Eigen::VectorXd& x, double objective_factor,
                                        const Eigen::VectorXd& multipliers) {
  const Pattern pattern = make_pattern(problem);
  ConvexDerivatives d;
  d.constraints = constraint_values(problem, x);
  d.jacobian = Eigen::MatrixXd::Zero(d.constraints.size(), x.size());
  for (std::size_t i = 0; i < pattern.jacobian_rows.size(); ++i) {
    const Index r = pattern.jacobian_rows[i];
    const Index c = pattern.jacobian_columns[i];
    d.jacobian(r, c) = jacobian_entry(problem, x, r, c);
  }
  d.lagrangian_hessian = Eigen::MatrixXd::Zero(x.size(), x.size());
  for (std::size_t i = 0; i < pattern.hessian_rows.size(); ++i) {
    const Index r = pattern.hessian_rows[i];
    const Index c = pattern.hessian_columns[i];
    const double h = hessian_entry(problem, objective_factor, multipliers.data(), r, c);
    d.lagrangian_hessian(r, c) = h;
    d.lagrangian_hessian(c, r) = h;
  }
  return d;
}

}  // namespace tern
