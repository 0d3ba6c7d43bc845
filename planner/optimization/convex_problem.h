// Eq. 4 with the planes held fixed: a small convex problem in the free control points.
#pragma once

#include <cstddef>
#include <vector>

#include "planner/optimization/trajectory_problem.h"

namespace tern {

/// min ½ xᵀH x + gᵀx + c   subject to   A x ≤ b   and   ‖W_k x + p_k‖² ≤ r² for each sphere point k.
///
/// x stacks the free control points (x, y, z of q_3, then q_4 …), n = 3(J − 2) numbers. What grows with the number of
/// constraints keeps its memory when the problem is made anew.
struct ConvexProblem {
  Eigen::MatrixXd hessian;             ///< H, n×n, symmetric positive definite
  Eigen::VectorXd gradient;            ///< g
  double constant = 0.0;               ///< c
  std::vector<double> rows;            ///< A, n numbers per constraint, one constraint after the other
  std::vector<double> bounds;          ///< b
  std::vector<double> sphere_weights;  ///< per sphere point the scalar weight of each free control point, J − 2 numbers
  std::vector<Vec3> sphere_offsets;    ///< p_k, relative to the sphere's centre
  double sphere_radius2 = 0.0;         ///< r²

  [[nodiscard]] int variables() const { return static_cast<int>(gradient.size()); }
  [[nodiscard]] int row_count() const { return static_cast<int>(bounds.size()); }
  [[nodiscard]] int spheres() const { return static_cast<int>(sphere_offsets.size()); }
  /// A_r, n numbers.
  [[nodiscard]] const double* row(int r) const { return rows.data() + static_cast<std::ptrdiff_t>(r) * variables(); }
  /// A_r x.
  [[nodiscard]] double row_times(int r, const FreeVariables& x) const;
  /// The weight in W_k of the free control point that variable c belongs to.
  [[nodiscard]] double sphere_weight(int k, int c) const {
    const int weight = k * (variables() / 3) + c / 3;
    return sphere_weights[idx(weight)];
  }
  /// W_k x + p_k.
  [[nodiscard]] Vec3 sphere_point(int k, const FreeVariables& x) const;
  [[nodiscard]] double objective(const FreeVariables& x) const;
  /// The largest violation of any constraint (rows: as they stand; spheres: in m²), ≤ 0 when x is feasible; NaN when
  /// one is.
  [[nodiscard]] double worst_violation(const FreeVariables& x) const;

  void add_row(const FreeVariables& row, double bound);
};

/// Room that x0 has to every bound, in the bound's unit (m, m/s, m/s², m/s³, m²). If x0 lay on opposite bounds, the
/// feasible set would have no interior, and the solver would fail (one in 10,000 recorded problems). A tenth of the
/// checker's tolerance (kLimitTolerance) for limits of 1, less for larger ones; what a smaller limit refuses, the
/// checker refuses.
inline constexpr double kStartRoom = 1e-7;

/// Builds the problem. x0 is the search's result; MINVO points bulge beyond the curve, so it may break bounds a little.
/// Such bounds are widened to x0's own value: x0 is always strictly feasible (by kStartRoom), and the checker decides
/// with true extrema. What x0 is far from is left out: each row costs.
///
/// @param out  filled anew; allocates only where it has never been as large
void make_convex_problem(const TrajectoryProblem& problem, const std::vector<PlaneConstraint>& planes,
                         const Points& initial_control_points, ConvexProblem& out);
ConvexProblem make_convex_problem(const TrajectoryProblem& problem, const std::vector<PlaneConstraint>& planes,
                                  const Points& initial_control_points);

}  // namespace tern
