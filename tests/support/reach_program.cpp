#include "tests/support/reach_program.h"

#include <glpk.h>

#include <memory>
#include <vector>

namespace tern::oracle {
namespace {

/// Columns a_l … a_{J−1}; rows v_{l+1} … v_J − v_l, then a_k − a_{k−1} for k = l … J.
class Programme {
 public:
  Programme(const ReachProgram& p, int l, double v, double a_previous)
      : lp_(glp_create_prob(), glp_delete_prob), p_(p), n_(p.intervals - l) {
    glp_term_out(GLP_OFF);
    glp_add_cols(lp_.get(), n_);
    for (int c = 1; c <= n_; ++c) glp_set_col_bnds(lp_.get(), c, GLP_DB, -p.a_max, p.a_max);
    for (int k = 1; k <= n_; ++k) {
      std::vector<double> row(static_cast<std::size_t>(n_) + 1, 0.0);
      for (int c = 1; c <= k; ++c) row[static_cast<std::size_t>(c)] = p.interval_s;
      if (k < n_)
        add_row(row, -p.v_max - v, p.v_max - v);
      else
        add_row(row, -v, -v);
    }
    const double step = p.j_max * p.interval_s;
    for (int k = 0; k <= n_; ++k) {
      std::vector<double> row(static_cast<std::size_t>(n_) + 1, 0.0);
      if (k < n_) row[static_cast<std::size_t>(k) + 1] = 1.0;
      if (k > 0) row[static_cast<std::size_t>(k)] = -1.0;
      const double shift = k == 0 ? a_previous : 0.0;
      add_row(row, shift - step, shift + step);
    }
  }

  /// sign·a_l at its greatest.
  std::optional<double> extreme(double sign) {
    glp_set_obj_dir(lp_.get(), GLP_MAX);
    for (int c = 1; c <= n_; ++c) glp_set_obj_coef(lp_.get(), c, c == 1 ? sign : 0.0);
    glp_smcp parameters;
    glp_init_smcp(&parameters);
    parameters.msg_lev = GLP_MSG_OFF;
    parameters.tol_bnd = 1e-10;
    glp_std_basis(lp_.get());
    if (glp_simplex(lp_.get(), &parameters) != 0 || glp_get_status(lp_.get()) != GLP_OPT) return std::nullopt;
    return sign * glp_get_obj_val(lp_.get());
  }

 private:
  void add_row(const std::vector<double>& row, double low, double high) {
    const int r = glp_add_rows(lp_.get(), 1);
    glp_set_row_bnds(lp_.get(), r, low == high ? GLP_FX : GLP_DB, low, high);
    std::vector<int> columns(static_cast<std::size_t>(n_) + 1);
    for (int c = 1; c <= n_; ++c) columns[static_cast<std::size_t>(c)] = c;
    glp_set_mat_row(lp_.get(), r, n_, columns.data(), row.data());
  }

  std::unique_ptr<glp_prob, decltype(&glp_delete_prob)> lp_;
  const ReachProgram& p_;
  int n_;
};

}  // namespace

std::optional<Reach> next_velocity(const ReachProgram& program, int l, double v, double a_previous) {
  Programme lp(program, l, v, a_previous);
  const auto low = lp.extreme(-1.0);
  const auto high = lp.extreme(1.0);
  if (!low || !high) return std::nullopt;
  return Reach{v + *low * program.interval_s, v + *high * program.interval_s};
}

}  // namespace tern::oracle
