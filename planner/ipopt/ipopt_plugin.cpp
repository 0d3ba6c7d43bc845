// tern-ipopt.so: Ipopt behind the interface of planner/optimization/nlp_plugin.h, its only use in Tern.
#include <IpIpoptApplication.hpp>
#include <IpTNLP.hpp>
#include <algorithm>

#include "planner/optimization/nlp_plugin.h"

namespace {

using Ipopt::Index;
using Ipopt::Number;

constexpr double kNoBound = 2e19;  // Ipopt's infinity

class Nlp final : public Ipopt::TNLP {
 public:
  explicit Nlp(const TernNlp& nlp) : p_(nlp) {}

  [[nodiscard]] int iterations() const { return iterations_; }

  bool get_nlp_info(Index& n, Index& m, Index& jacobian_entries, Index& hessian_entries,
                    IndexStyleEnum& style) override {
    n = p_.variables;
    m = p_.constraints;
    jacobian_entries = p_.jacobian_entries;
    hessian_entries = p_.hessian_entries;
    style = C_STYLE;
    return true;
  }

  bool get_bounds_info(Index n, Number* x_low, Number* x_high, Index m, Number* g_low, Number* g_high) override {
    std::fill_n(x_low, n, -kNoBound);
    std::fill_n(x_high, n, kNoBound);
    std::fill_n(g_low, m, -kNoBound);
    std::copy_n(p_.bounds, m, g_high);
    return true;
  }

  bool get_starting_point(Index n, bool, Number* x, bool, Number*, Number*, Index, bool, Number*) override {
    std::copy_n(p_.start, n, x);
    return true;
  }

  bool eval_f(Index, const Number* x, bool, Number& value) override {
    value = p_.objective(p_.problem, x);
    return true;
  }

  bool eval_grad_f(Index, const Number* x, bool, Number* gradient) override {
    p_.gradient(p_.problem, x, gradient);
    return true;
  }

  bool eval_g(Index, const Number* x, bool, Index, Number* g) override {
    p_.constraint_values(p_.problem, x, g);
    return true;
  }

  bool eval_jac_g(Index, const Number* x, bool, Index, Index entries, Index* rows, Index* columns,
                  Number* values) override {
    if (values == nullptr) {
      std::copy_n(p_.jacobian_rows, entries, rows);
      std::copy_n(p_.jacobian_columns, entries, columns);
    } else {
      p_.jacobian(p_.problem, x, values);
    }
    return true;
  }

  bool eval_h(Index, const Number* x, bool, Number factor, Index, const Number* multipliers, bool, Index entries,
              Index* rows, Index* columns, Number* values) override {
    if (values == nullptr) {
      std::copy_n(p_.hessian_rows, entries, rows);
      std::copy_n(p_.hessian_columns, entries, columns);
    } else {
      p_.hessian(p_.problem, x, factor, multipliers, values);
    }
    return true;
  }

  bool intermediate_callback(Ipopt::AlgorithmMode, Index iteration, Number, Number, Number, Number, Number, Number,
                             Number, Number, Index, const Ipopt::IpoptData*,
                             Ipopt::IpoptCalculatedQuantities*) override {
    iterations_ = iteration;
    return p_.stop(p_.problem) == 0;
  }

  void finalize_solution(Ipopt::SolverReturn, Index, const Number*, const Number*, const Number*, Index, const Number*,
                         const Number*, Number, const Ipopt::IpoptData*, Ipopt::IpoptCalculatedQuantities*) override {}

 private:
  const TernNlp& p_;
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

/// See kTernNlpMinimise.
extern "C" __attribute__((visibility("default"))) TernNlpRun tern_nlp_minimise_1(const TernNlp* nlp,
                                                                                 int max_iterations) {
  Ipopt::SmartPtr<Ipopt::IpoptApplication> app = new Ipopt::IpoptApplication(false);
  set_options(*app, max_iterations);
  if (app->Initialize("") != Ipopt::Solve_Succeeded) return {1, 0};
  Ipopt::SmartPtr<Nlp> problem = new Nlp(*nlp);
  const Ipopt::ApplicationReturnStatus status = app->OptimizeTNLP(Ipopt::SmartPtr<Ipopt::TNLP>(GetRawPtr(problem)));
  const bool failed = status != Ipopt::Solve_Succeeded && status != Ipopt::Solved_To_Acceptable_Level &&
                      status != Ipopt::User_Requested_Stop && status != Ipopt::Maximum_Iterations_Exceeded;
  return {failed ? 1 : 0, problem->iterations()};
}
