// Eq. 4 with fixed planes: a small convex problem in the free control points.
#pragma once

#include <cstddef>
#include <vector>

#include "planner/optimization/trajectory_problem.h"

namespace tern {

/// min ½ xᵀH x + gᵀx + c   subject to   A x ≤ b   and   ‖W_k x + p_k‖² ≤ r² for each sphere point k.
///
/// x stacks the free control points: x, y, z of q_3, then of q_4 …, together n = 3(J − 2) numbers. The vectors that
/// grow with the number of constraints keep their memory when the problem is made again.
struct ConvexProblem {
  Eigen::MatrixXd hessian;             ///< H, n×n, symmetric positive definite
  Eigen::VectorXd gradient;            ///< g
  double constant = 0.0;               ///< c
  std::vector<double> rows;            ///< A, n numbers per constraint, one constraint after the other
  std::vector<double> bounds;          ///< b
  std::vector<double> sphere_weights;  ///< J − 2 scalar weights per sphere point, one per free control point
  std::vector<Vec3> sphere_offsets;    ///< p_k, relative to the sphere's centre
  double sphere_radius2 = 0.0;         ///< r²

  [[nodiscard]] int variables() const { return static_cast<int>(gradient.size()); }
  [[nodiscard]] int row_count() const { return static_cast<int>(bounds.size()); }
  [[nodiscard]] int spheres() const { return static_cast<int>(sphere_offsets.size()); }
  /// Returns A_r, n numbers.
  [[nodiscard]] const double* row(int r) const { return rows.data() + static_cast<std::ptrdiff_t>(r) * variables(); }
  /// Returns A_r x.
  [[nodiscard]] double row_times(int r, const FreeVariables& x) const;
  /// Returns the weight in W_k of the free control point that variable c belongs to.
  [[nodiscard]] double sphere_weight(int k, int c) const {
    const int weight = k * (variables() / 3) + c / 3;
    return sphere_weights[idx(weight)];
  }
  /// Returns W_k x + p_k.
  [[nodiscard]] Vec3 sphere_point(int k, const FreeVariables& x) const;
  [[nodiscard]] double objective(const FreeVariables& x) const;
  /// Returns the largest violation of any constraint: rows in their own unit, spheres in m². It is ≤ 0 for a feasible
  /// x, and NaN if any violation is NaN.
  [[nodiscard]] double worst_violation(const FreeVariables& x) const;

  void add_row(const FreeVariables& row, double bound);
};

/// Room from x0 to every bound, in the bound's unit (m, m/s, m/s², m/s³, m²).
///
/// If x0 lay on opposite bounds, the feasible set would have no interior, and the solver would fail. That happened in
/// one of 10,000 recorded problems. For limits of 1 the room is a tenth of the checker's tolerance (kLimitTolerance). A
/// result that breaks a smaller limit is rejected by the checker.
inline constexpr double kStartRoom = 1e-7;

/// Builds the problem around x0, the search's result.
///
/// MINVO points bulge beyond the curve, so x0 may break bounds slightly. Such bounds are widened to the value of x0,
/// and x0 is always strictly feasible (by kStartRoom). The checker decides later by true extrema. Constraints far from
/// x0 are left out, since each row costs time.
/// @param out  filled from the start; allocates only if it has never been as large
void make_convex_problem(const TrajectoryProblem& problem, const std::vector<PlaneConstraint>& planes,
                         const Points& initial_control_points, ConvexProblem& out);
ConvexProblem make_convex_problem(const TrajectoryProblem& problem, const std::vector<PlaneConstraint>& planes,
                                  const Points& initial_control_points);

}  // namespace tern
