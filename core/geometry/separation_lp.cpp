#include "core/geometry/separation_lp.h"

#include <fmt/format.h>
#include <glpk.h>

#include <array>
#include <memory>
#include <stdexcept>

namespace tern {
namespace {

struct DeleteProblem {
  void operator()(glp_prob* problem) const { glp_delete_prob(problem); }
};
using Problem = std::unique_ptr<glp_prob, DeleteProblem>;

// Coordinates are moved to `origin` and divided by `size`, so that the simplex method sees numbers near 1.
void add_rows(glp_prob* problem, const Points& points, const Vec3& origin, double size, int first, int bound,
              double value) {
  for (int i = 0; i < static_cast<int>(points.cols()); ++i) {
    const Vec3 p = (points.col(i) - origin) / size;
    const std::array<int, 5> columns{0, 1, 2, 3, 4};
    const std::array<double, 5> row{0.0, p.x(), p.y(), p.z(), 1.0};
    glp_set_row_bnds(problem, first + i, bound, value, value);
    glp_set_mat_row(problem, first + i, 4, columns.data(), row.data());
  }
}

void check(const Points& a, const Points& b) {
  if (a.cols() > 0 && b.cols() > 0 && a.allFinite() && b.allFinite()) return;
  throw std::invalid_argument(fmt::format("separate_by_lp: {} and {} points, finite: {} and {}", a.cols(), b.cols(),
                                          a.allFinite(), b.allFinite()));
}

}  // namespace

std::optional<Plane> separate_by_lp(const Points& a, const Points& b) {
  check(a, b);
  const Vec3 origin = b.col(0);
  const double size =
      std::max((a.colwise() - origin).cwiseAbs().maxCoeff(), (b.colwise() - origin).cwiseAbs().maxCoeff());
  if (!(size > 0.0)) return std::nullopt;

  glp_term_out(GLP_OFF);
  const Problem problem(glp_create_prob());
  const auto rows_a = static_cast<int>(a.cols());
  const auto rows_b = static_cast<int>(b.cols());
  glp_add_cols(problem.get(), 4);
  for (int column = 1; column <= 4; ++column) glp_set_col_bnds(problem.get(), column, GLP_FR, 0.0, 0.0);
  glp_add_rows(problem.get(), rows_a + rows_b);
  add_rows(problem.get(), a, origin, size, 1, GLP_LO, 1.0);
  add_rows(problem.get(), b, origin, size, 1 + rows_a, GLP_UP, -1.0);

  glp_smcp parameters;
  glp_init_smcp(&parameters);
  parameters.msg_lev = GLP_MSG_OFF;
  parameters.tol_bnd = 1e-9;
  parameters.tol_piv = 1e-12;
  const auto feasible = [&] {
    return glp_simplex(problem.get(), &parameters) == 0 && glp_get_prim_stat(problem.get()) == GLP_FEAS;
  };
  if (!feasible()) {
    glp_scale_prob(problem.get(), GLP_SF_GM | GLP_SF_EQ);
    glp_std_basis(problem.get());
    if (!feasible()) return std::nullopt;
  }

  const Vec3 direction(glp_get_col_prim(problem.get(), 1), glp_get_col_prim(problem.get(), 2),
                       glp_get_col_prim(problem.get(), 3));
  const double length = direction.norm();
  if (!(length > 0.0)) return std::nullopt;
  const Vec3 n = direction / length;
  const double lowest_a = (n.transpose() * a).minCoeff();
  const double highest_b = (n.transpose() * b).maxCoeff();
  if (!(lowest_a > highest_b)) return std::nullopt;
  return Plane{n, -0.5 * (lowest_a + highest_b)};
}

}  // namespace tern
